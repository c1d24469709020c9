#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/exchange/message.hpp"

namespace polynya::coupler {

/// Named scalars that a participant reports about its own state: energies (J), momentum (kg m/s), masses (kg).
/// The names come once in `ready`, the values with every message.
class Account {
 public:
  void set_names(const exchange::Message& ready);
  void update(const exchange::Message& message);
  /// Takes this report as the first one.
  void set_initial(const exchange::Message& message);

  bool has(std::string_view name) const;
  /// Value of an entry, 0 if the participant does not report it.
  double operator[](std::string_view name) const;
  /// Change since the first report.
  double change(std::string_view name) const { return (*this)[name] - initial(name); }
  double initial(std::string_view name) const;
  /// Sum of the changes of all names given that are reported.
  double change(std::initializer_list<std::string_view> names) const;
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<double>& values() const { return values_; }

  POLYNYA_STATE(names_, values_, initial_)

 private:
  std::vector<std::string> names_;
  std::vector<double> values_, initial_;
};

}  // namespace polynya::coupler
