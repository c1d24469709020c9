#include "core/scene/material_cards.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/scene/scene_error.hpp"

namespace polynya::scene {
namespace {

namespace dim = dimension;
constexpr double any = -std::numeric_limits<double>::infinity();

LawValue positive(std::string name, Dimension d = dim::none) {
  return {std::move(name), d, 0, true};
}
LawValue not_negative(std::string name, Dimension d = dim::none) {
  return {std::move(name), d, 0, false};
}
LawValue free_value(std::string name, Dimension d = dim::none) {
  return {std::move(name), d, any, false};
}

const std::map<std::string, std::vector<LawValue>>& laws() {
  static const std::map<std::string, std::vector<LawValue>> table{
      {"elastic",
       {positive("density", dim::density), positive("youngs_modulus", dim::pressure), free_value("poisson_ratio")}},
      {"j2_plastic",
       {positive("density", dim::density), positive("youngs_modulus", dim::pressure), free_value("poisson_ratio"),
        positive("yield_stress", dim::pressure), not_negative("hardening_modulus", dim::pressure),
        LawValue{"failure_strain", dim::none, 0, true, true}}},
      {"johnson_holmquist_2",
       {positive("density", dim::density), positive("shear_modulus", dim::pressure),
        positive("bulk_modulus", dim::pressure), free_value("bulk_modulus_2", dim::pressure),
        free_value("bulk_modulus_3", dim::pressure), positive("hugoniot_elastic_limit", dim::pressure),
        positive("pressure_at_hugoniot_elastic_limit", dim::pressure), positive("intact_strength_constant"),
        positive("intact_strength_exponent"), not_negative("strain_rate_constant"),
        not_negative("fractured_strength_constant"), positive("fractured_strength_exponent"),
        positive("maximum_tensile_pressure", dim::pressure), not_negative("damage_constant"),
        not_negative("damage_exponent"), not_negative("bulking_fraction"),
        positive("reference_strain_rate", dim::frequency),
        LawValue{"maximum_fractured_strength", dim::none, 0, true, true},
        LawValue{"fracture_energy", dim::energy_per_area, 0, true, true}}},
      {"mie_grueneisen",
       {positive("density", dim::density), positive("sound_speed", dim::speed), free_value("slope_1"),
        free_value("slope_2"), free_value("slope_3"), not_negative("grueneisen"), free_value("grueneisen_slope"),
        not_negative("vapour_pressure", dim::pressure)}},
      {"linear_polynomial",
       {positive("density", dim::density), free_value("c0", dim::pressure), free_value("c1", dim::pressure),
        free_value("c2", dim::pressure), free_value("c3", dim::pressure), free_value("c4"), free_value("c5"),
        free_value("c6"), not_negative("initial_energy", dim::pressure)}},
      {"ideal_gas", {positive("density", dim::density), {"ratio_of_specific_heats", dim::none, 1, true}}},
      {"stiffened_gas",
       {positive("density", dim::density),
        {"ratio_of_specific_heats", dim::none, 1, true},
        not_negative("stiffening_pressure", dim::pressure)}},
      {"tait",
       {positive("density", dim::density), not_negative("reference_pressure", dim::pressure),
        positive("stiffness", dim::pressure), positive("exponent")}},
  };
  return table;
}

double read_value(const Entry& entry, const LawValue& law_value, const std::string& key) {
  const auto fail = [&](const std::string& what) {
    throw SceneError(entry.where + ": " + key + ": " + what + "; must be " + describe(law_value.dimension));
  };
  Quantity quantity{.value = 0, .dimension = law_value.dimension, .bare = true};
  if (const auto* text = std::get_if<std::string>(&entry.value)) {
    try {
      quantity = parse_quantity(*text);
    } catch (const std::invalid_argument& error) {
      fail(error.what());
    }
  } else if (const auto* number = std::get_if<double>(&entry.value)) {
    quantity.value = *number;
  } else if (const auto* whole = std::get_if<long>(&entry.value)) {
    quantity.value = static_cast<double>(*whole);
  } else {
    fail("found true or false");
  }
  // A rate or modulus of zero needs no unit, and neither does any bare SI number.
  if (!quantity.bare && quantity.dimension != law_value.dimension)
    fail("wrong dimension, found " +
         (quantity.dimension == Dimension{} ? "a plain number" : unit_name(quantity.dimension)));
  if (!std::isfinite(quantity.value) || quantity.value < law_value.lower ||
      (law_value.lower_open && quantity.value == law_value.lower))
    fail("impossible value, allowed is " + std::string(law_value.lower_open ? "above " : "at least ") +
         std::to_string(static_cast<int>(law_value.lower)));
  return quantity.value;
}

std::vector<std::string> names_of(const std::vector<LawValue>& values) {
  std::vector<std::string> names;
  for (const auto& value : values) names.push_back(value.name);
  return names;
}

[[noreturn]] void fail_unknown_value(const std::string& where, const std::string& key, const std::string& law) {
  const auto names = names_of(law_values(law));
  const auto near = nearest(key, names);
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  throw SceneError(where + ": unknown value '" + key + "' of law " + law +
                   (near.empty() ? "; it has " + list : "; did you mean '" + near + "'?"));
}

std::string text_of(const Document& document, const std::string& key) {
  const auto found = document.values.find(key);
  const auto* text = found == document.values.end() ? nullptr : std::get_if<std::string>(&found->second.value);
  if (!text) throw SceneError(document.file.string() + ": " + key + ": missing, must be a text");
  return *text;
}

void check_origin(const std::string& origin, const std::string& where) {
  for (const std::string_view start : {"literature: ", "calibrated: ", "assumed: "})
    if (origin.starts_with(start) && origin.size() > start.size()) return;
  throw SceneError(where + ": must say which after \"literature: \", \"calibrated: \" or \"assumed: \"");
}

void check_value_keys(const Document& document, const std::string& law) {
  for (const auto& [path, entry] : document.values) {
    if (path == "law" || path == "summary") continue;
    const auto dot = path.find('.');
    const auto value = path.substr(0, dot), part = dot == std::string::npos ? "" : path.substr(dot + 1);
    const auto names = names_of(law_values(law));
    if (std::find(names.begin(), names.end(), value) == names.end()) fail_unknown_value(entry.where, value, law);
    if (part != "value" && part != "origin")
      throw SceneError(entry.where + ": unknown key '" + path + "'; a value has the keys value and origin");
  }
}

}  // namespace

const std::vector<LawValue>& law_values(const std::string& law) {
  return laws().at(law);
}

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, values] : laws()) list.push_back(name);
    return list;
  }();
  return names;
}

std::filesystem::path project_materials() {
  return POLYNYA_MATERIALS_DIRECTORY;
}

MaterialCard load_card(const std::filesystem::path& file) {
  const Document document = read_document(file);
  MaterialCard card;
  card.name = file.stem().string();
  card.law = text_of(document, "law");
  if (!laws().contains(card.law)) {
    std::string list;
    for (const auto& name : law_names()) list += (list.empty() ? "" : ", ") + name;
    throw SceneError(document.values.at("law").where + ": law: unknown law '" + card.law + "'; one of " + list);
  }
  text_of(document, "summary");
  check_value_keys(document, card.law);
  for (const LawValue& value : law_values(card.law)) {
    const auto found = document.values.find(value.name + ".value");
    if (found == document.values.end()) {
      if (value.optional) continue;
      throw SceneError(file.string() + ": " + value.name + ": missing, law " + card.law + " needs " +
                       describe(value.dimension));
    }
    card.values[value.name] = read_value(found->second, value, value.name);
    card.origin[value.name] = text_of(document, value.name + ".origin");
    check_origin(card.origin[value.name],
                 document.values.at(value.name + ".origin").where + ": " + value.name + ".origin");
  }
  return card;
}

MaterialCard find_card(const std::string& name, const std::vector<std::filesystem::path>& folders,
                       const std::string& asked) {
  std::vector<std::string> names;
  for (const auto& folder : folders) {
    if (!std::filesystem::is_directory(folder)) continue;
    for (const auto& item : std::filesystem::directory_iterator(folder))
      if (item.path().extension() == ".toml") names.push_back(item.path().stem().string());
    if (std::filesystem::exists(folder / (name + ".toml"))) return load_card(folder / (name + ".toml"));
  }
  std::sort(names.begin(), names.end());
  std::string list;
  for (const auto& known : names) list += (list.empty() ? "" : ", ") + known;
  const auto near = nearest(name, names);
  throw SceneError(asked + ": no card of that name; " + (near.empty() ? "" : "did you mean '" + near + "'? ") +
                   "known: " + list);
}

void override_values(MaterialCard& card, const Document& values) {
  for (const auto& [key, entry] : values.values) {
    const auto& known = law_values(card.law);
    const auto rule =
        std::find_if(known.begin(), known.end(), [&](const LawValue& value) { return value.name == key; });
    if (rule == known.end()) fail_unknown_value(entry.where, key, card.law);
    card.values[key] = read_value(entry, *rule, "materials." + card.name + "." + key);
    card.origin[key] = "assumed: given by the scene (" + entry.where + ")";
  }
}

void check_card(const MaterialCard& card) {
  if ((card.law == "elastic" || card.law == "j2_plastic") &&
      !(card.value("poisson_ratio") > -1 && card.value("poisson_ratio") < 0.5))
    throw std::invalid_argument("poisson_ratio must lie between -1 and 0.5");
  if (card.law == "johnson_holmquist_2" &&
      card.value("hugoniot_elastic_limit") <= card.value("pressure_at_hugoniot_elastic_limit"))
    throw std::invalid_argument("hugoniot_elastic_limit must exceed pressure_at_hugoniot_elastic_limit");
  if (card.law == "linear_polynomial" && card.value("c1") <= 0 && card.value("c4") <= 0)
    throw std::invalid_argument("c1 or c4 must be above 0, or pressure would not resist compression");
}

}  // namespace polynya::scene
