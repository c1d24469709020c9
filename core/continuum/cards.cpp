#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "core/continuum/law.hpp"

namespace polynya::continuum {
namespace {

/// Reads values of one card and says what is wrong with them.
class Card {
 public:
  Card(const std::string& name, const std::map<std::string, double>& values) : name_(name), values_(values) {}

  [[noreturn]] void refuse(const std::string& key, const std::string& reason) const {
    throw std::invalid_argument("material card '" + name_ + "': " + key + " " + reason);
  }
  double optional(const std::string& key, double otherwise) const {
    const auto found = values_.find(key);
    if (found == values_.end()) return otherwise;
    if (!std::isfinite(found->second)) refuse(key, "must be finite, it is " + std::to_string(found->second));
    return found->second;
  }
  double required(const std::string& key) const {
    if (!values_.contains(key)) refuse(key, "is missing");
    return optional(key, 0);
  }
  double positive(const std::string& key) const {
    const double value = required(key);
    if (!(value > 0)) refuse(key, "must be positive, it is " + std::to_string(value));
    return value;
  }
  double not_negative(const std::string& key) const {
    const double value = required(key);
    if (!(value >= 0)) refuse(key, "must not be negative, it is " + std::to_string(value));
    return value;
  }

 private:
  const std::string& name_;
  const std::map<std::string, double>& values_;
};

}  // namespace

Elastic elastic_from_card(const std::string& card, const std::map<std::string, double>& values) {
  const Card read(card, values);
  const double young = read.positive("youngs_modulus"), poisson = read.required("poisson_ratio");
  if (!(poisson > -1 && poisson < 0.5))
    read.refuse("poisson_ratio", "must lie between -1 and 0.5, it is " + std::to_string(poisson));
  return {read.positive("density"), young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

J2Plastic j2_plastic_from_card(const std::string& card, const std::map<std::string, double>& values) {
  const Card read(card, values);
  const Elastic elastic = elastic_from_card(card, values);
  J2Plastic law{elastic.density, elastic.bulk_modulus, elastic.shear_modulus};
  law.yield_stress = read.positive("yield_stress");
  if (values.contains("hardening_modulus")) law.hardening_modulus = read.not_negative("hardening_modulus");
  if (values.contains("failure_strain")) law.failure_strain = read.positive("failure_strain");
  return law;
}

JohnsonHolmquist2 johnson_holmquist_2_from_card(const std::string& card, const std::map<std::string, double>& values) {
  const Card read(card, values);
  JohnsonHolmquist2 law;
  law.density = read.positive("density");
  law.shear_modulus = read.positive("shear_modulus");
  law.bulk_modulus = read.positive("bulk_modulus");
  law.bulk_modulus_2 = read.optional("bulk_modulus_2", 0);
  law.bulk_modulus_3 = read.optional("bulk_modulus_3", 0);
  law.pressure_at_hugoniot_elastic_limit = read.positive("pressure_at_hugoniot_elastic_limit");
  const double limit = read.positive("hugoniot_elastic_limit");
  if (!(limit > law.pressure_at_hugoniot_elastic_limit))
    read.refuse("hugoniot_elastic_limit",
                "must exceed pressure_at_hugoniot_elastic_limit, it is " + std::to_string(limit) + " Pa");
  law.stress_at_hugoniot_elastic_limit = 1.5 * (limit - law.pressure_at_hugoniot_elastic_limit);
  law.intact_strength_constant = read.positive("intact_strength_constant");
  law.intact_strength_exponent = read.not_negative("intact_strength_exponent");
  law.strain_rate_constant = read.not_negative("strain_rate_constant");
  law.fractured_strength_constant = read.not_negative("fractured_strength_constant");
  law.fractured_strength_exponent = read.not_negative("fractured_strength_exponent");
  law.maximum_tensile_pressure = read.not_negative("maximum_tensile_pressure");
  law.damage_constant = read.not_negative("damage_constant");
  law.damage_exponent = read.required("damage_exponent");
  law.bulking_fraction = read.optional("bulking_fraction", 0);
  if (!(law.bulking_fraction >= 0 && law.bulking_fraction <= 1))
    read.refuse("bulking_fraction", "must lie between 0 and 1, it is " + std::to_string(law.bulking_fraction));
  law.reference_strain_rate = values.contains("reference_strain_rate") ? read.positive("reference_strain_rate") : 1.0;
  law.maximum_fractured_strength =
      values.contains("maximum_fractured_strength") ? read.positive("maximum_fractured_strength") : 1e300;
  if (values.contains("fracture_energy")) law.fracture_energy = read.positive("fracture_energy");
  // The tangent K1 + 2 K2 mu + 3 K3 mu^2 must stay positive where the law is used.
  for (double mu = 0; mu <= 0.3; mu += 0.01)
    if (!(law.bulk_modulus + mu * (2 * law.bulk_modulus_2 + 3 * law.bulk_modulus_3 * mu) > 0))
      read.refuse("bulk_modulus_2", "and bulk_modulus_3 give a falling pressure at mu = " + std::to_string(mu));
  return law;
}

Law law_from_card(const std::string& card, const std::string& law, const std::map<std::string, double>& values) {
  if (law == "elastic") return elastic_from_card(card, values);
  if (law == "j2_plastic") return j2_plastic_from_card(card, values);
  if (law == "johnson_holmquist_2") return johnson_holmquist_2_from_card(card, values);
  throw std::invalid_argument("material card '" + card + "': law is '" + law +
                              "', a solid needs elastic, j2_plastic or johnson_holmquist_2");
}

double density(const Law& law) {
  return std::visit([](const auto& l) { return l.density; }, law);
}

void set_density(Law& law, double density) {
  std::visit([&](auto& l) { l.density = density; }, law);
}

Elastic elastic_part(const Law& law) {
  return std::visit([](const auto& l) { return Elastic{l.density, l.bulk_modulus, l.shear_modulus}; }, law);
}

double longitudinal_wave_speed(const Law& law) {
  return std::visit([](const auto& l) { return wave_speed(l, PointState<double>{}); }, law);
}

double shear_wave_speed(const Law& law) {
  return std::visit([](const auto& l) { return std::sqrt(l.shear_modulus / l.density); }, law);
}

}  // namespace polynya::continuum
