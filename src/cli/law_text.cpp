#include "law_text.hpp"

#include <fmt/format.h>

namespace springfold::cli {
namespace {

struct LawText {
  std::string operator()(const model::LinearSpring& s) const {
    return fmt::format("stiffness {:.6g}, free {:.6g}", s.stiffness, s.free);
  }
  std::string operator()(const model::OneSidedSpring& s) const {
    return fmt::format("stiffness {:.6g} {} {:.6g}", s.stiffness,
                       s.side == model::OneSidedSpring::Side::above ? "above" : "below", s.from);
  }
  std::string operator()(const model::PiecewiseLinearSpring& s) const {
    return fmt::format("law of {} straight lines, free {:.6g}", s.stiffnesses.size(), s.free);
  }
  std::string operator()(const model::TableSpring& s) const {
    return fmt::format("table of {} points, free {:.6g}", s.torques.size(), s.free);
  }
  std::string operator()(const model::PolynomialSpring& s) const {
    return fmt::format("polynomial law, free {:.6g}", s.free);
  }
  std::string operator()(const model::FormulaSpring& s) const {
    return fmt::format("law by a formula, free {:.6g}", s.free);
  }
  std::string operator()(const model::LogarithmicSpring& s) const {
    return fmt::format("logarithmic law, stiffness {:.6g}, free {:.6g}", s.stiffness, s.free);
  }
  std::string operator()(const model::PowerSpring& s) const {
    return fmt::format("power law, exponent {:.6g} {} {:.6g}", s.exponent,
                       s.below ? "below" : "above", s.from);
  }
};

}  // namespace

std::string law_text(const model::SpringLaw& law) { return std::visit(LawText{}, law); }

}  // namespace springfold::cli
