#pragma once
#include <string>
#include <vector>

#include "core/scene/units.hpp"
#include "core/scene/values.hpp"

/// Texts that hold rows of numbers with units. Errors name the key and show `example`. Internal to the library.
namespace polynya::scene {

/// "A, B, C": exactly `count` numbers, each with the dimension or without a unit.
std::vector<double> row_in(const Values& values, const std::string& key, const std::string& text, std::size_t count,
                           const Dimension& dimension, const std::string& example);

/// "ROW" or "ROW at TIME; ROW at TIME; ...", times (s) from 0 on; rows: [times][count].
void read_table(const Values& values, const std::string& key, std::size_t count, const Dimension& dimension,
                const std::string& example, std::vector<double>& times, std::vector<double>& rows);

}  // namespace polynya::scene
