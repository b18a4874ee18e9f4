#include "form.hpp"

#include <algorithm>

namespace springfold::statics {
namespace {

bool has_form_of(const model::Chain& a, const model::Chain& b) {
  if (a.name != b.name || a.from != b.from || a.to != b.to ||
      a.elements.size() != b.elements.size() ||
      a.coupled_springs.size() != b.coupled_springs.size())
    return false;
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    const auto* one = std::get_if<model::Joint>(&a.elements[i]);
    const auto* other = std::get_if<model::Joint>(&b.elements[i]);
    if ((one == nullptr) != (other == nullptr)) return false;
    if (one != nullptr &&
        (one->name != other->name || one->kind != other->kind || one->role != other->role ||
         one->spring.has_value() != other->spring.has_value()))
      return false;
  }
  for (std::size_t i = 0; i < a.coupled_springs.size(); ++i)
    if (a.coupled_springs[i].elements != b.coupled_springs[i].elements) return false;
  return true;
}

}  // namespace

bool has_form_of(const model::Mechanism& a, const model::Mechanism& b) {
  const auto same_chain = [](const model::Chain& one, const model::Chain& other) {
    return has_form_of(one, other);
  };
  const auto same_body = [](const model::Body& one, const model::Body& other) {
    return one.name == other.name && one.task_space == other.task_space;
  };
  const auto same_inner = [](const model::ShapeSpring& one, const model::ShapeSpring& other) {
    return one.before.size() == other.before.size() &&
           (one.before.empty() || (one.name == other.name && one.shape.kind == other.shape.kind));
  };
  return std::equal(a.shape_springs.begin(), a.shape_springs.end(), b.shape_springs.begin(),
                    b.shape_springs.end(), same_inner) &&
         std::equal(a.chains.begin(), a.chains.end(), b.chains.begin(), b.chains.end(),
                    same_chain) &&
         std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(), same_body);
}

}  // namespace springfold::statics
