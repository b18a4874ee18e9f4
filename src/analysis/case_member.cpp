// One value of the parameter: its start, and what is made of it when it is asked for.
#include "case_curves.hpp"
#include "start.hpp"
#include "undefined.hpp"

namespace springfold::analysis {

continuation::CurvePoint Member::start() const {
  continuation::CurvePoint start;
  start.x = problem->reduce(first.z);
  start.lambda = setup.lambda_start;
  start.piece = first.piece;
  count_negative(*problem, start);
  return start;
}

Vector Member::start_pose() const {
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(study.body - 1)];
  return first.z.segment(body.t, body.count);
}

Vector Member::counted_from() const {
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(study.body - 1)];
  return report.found ? start_pose() : Vector(Vector::Constant(body.count, undefined));
}

const std::vector<QuantityDefinition>& Member::quantities() const {
  if (columns_of != nullptr) return columns_of->quantities();
  if (quantities_.empty())
    quantities_ = quantities_of(study, setup.system, setup.scales, setup.lambda_scale,
                                lambda_unit_of(study, setup.system));
  return quantities_;
}

const Evaluator& Member::evaluator() const {
  if (!evaluator_)
    evaluator_ = std::make_unique<Evaluator>(*problem, study, setup.scales);
  else if (evaluator_is_old_)
    evaluator_->renew(study, setup.scales);
  evaluator_is_old_ = false;
  return *evaluator_;
}

void Member::forget_columns() {
  evaluator_is_old_ = true;
  quantities_.clear();
}

std::optional<CaseCurves::Followed> CaseCurves::followed_at(double mu) const {
  if (followed_) return followed_(mu);
  const Member* const member = equations_at(mu);
  if (member == nullptr) return std::nullopt;
  return Followed{member, member->problem.get(), &member->evaluator()};
}

const QuantityDefinition* Member::quantity(const std::string& name) const {
  return find_quantity(quantities(), name);
}

}  // namespace springfold::analysis
