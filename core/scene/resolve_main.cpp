// resolve_scene: scene file -> resolved JSON, and what the run would cost.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "core/scene/estimate.hpp"
#include "core/scene/resolve.hpp"
#include "core/scene/scene_error.hpp"
#include "core/scene/schema.hpp"

namespace {

using namespace polynya::scene;

/// Written aside and renamed: nobody reads half a scene.
void write(const std::string& text, const std::string& output) {
  if (output.empty()) {
    std::cout << text << '\n' << std::flush;
    return;
  }
  const std::string aside = output + ".tmp";
  std::ofstream file(aside);
  file << text << '\n';
  file.close();
  if (!file || std::rename(aside.c_str(), output.c_str()) != 0)
    throw std::runtime_error(output + ": cannot be written");
}

int run(const std::string& scene, const ResolveOptions& options, const std::string& output, bool explain) {
  if (const auto wanted = wanted_mesh(scene, options)) {
    write(nlohmann::json{{"wanted_mesh", to_json(*wanted)}}.dump(2), output);
    return 0;
  }
  const Scene resolved = resolve(scene, options);
  auto json = to_json(resolved);
  const auto folder = std::filesystem::path(output).parent_path();
  if (explain) json["estimate"] = to_json(estimate(resolved, machine(folder.empty() ? "." : folder)));
  write(json.dump(2), output);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Checks a scene file and writes the resolved scene as JSON"};
  std::string scene, output;
  ResolveOptions options;
  bool explain = false, keys = false;
  app.add_option("scene", scene, "folder with a scene.toml, or a TOML file");
  app.add_option("--level", options.level, "quick, standard or fine (quick if not given)");
  app.add_option("--set", options.settings, "key=value, e.g. vehicle.speed=\"60 m/s\"; may be repeated")
      ->expected(1)
      ->take_all();
  app.add_option("--mesh", options.mesh,
                 "facts of ice.mesh (JSON); without them the answer to a scene with such a mesh is {wanted_mesh}");
  app.add_option("--output", output, "file to write (standard output if not given)");
  app.add_flag("--explain", explain, "add an estimate of size, time, memory and disk");
  app.add_flag("--keys", keys, "print the table of all keys of a scene file, and stop");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "resolve_scene: " << error.what() << '\n';
    return 2;
  }
  try {
    if (keys) return write(schema_as_markdown(), output), 0;
    if (scene.empty()) throw SceneError("resolve_scene: give a scene: a folder with a scene.toml, or a TOML file");
    return run(scene, options, output, explain);
  } catch (const SceneError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "resolve_scene: " << error.what() << '\n';
    return 1;
  }
}
