#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/scene/resolve.hpp"
#include "core/scene/scene_error.hpp"

namespace polynya::scene {

/// Writes a scene file of this text into a folder of the running test and returns its path.
inline std::filesystem::path scene_file(const std::string& text) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "polynya_scene" /
                      testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::create_directories(folder);
  const auto file = folder / "scene.toml";
  std::ofstream(file) << text;
  return file;
}

inline std::filesystem::path case_folder(const std::string& name) {
  return std::filesystem::path(POLYNYA_SOURCE_DIR) / "cases" / name;
}

/// The message of the SceneError that resolving raises; empty if it raises none.
inline std::string message_of(const std::filesystem::path& file, const ResolveOptions& options = {}) {
  try {
    resolve(file, options);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

/// The same for settings on top of the base scene.
inline std::string message_of_settings(const std::vector<std::string>& settings) {
  return message_of(case_folder("water_exit"), {.level = {}, .settings = settings});
}

inline Scene base_scene(const std::vector<std::string>& settings = {}) {
  return resolve(case_folder("water_exit"), {.level = {}, .settings = settings});
}

}  // namespace polynya::scene
