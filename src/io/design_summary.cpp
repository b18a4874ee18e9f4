#include "design_summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "summary_line.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::BoundState;
using analysis::DesignReport;
using analysis::FoundParameter;
using analysis::FoundRequirement;
using Json = nlohmann::ordered_json;

std::string shown_number(double value) {
  return std::isnan(value) ? "-" : std::isinf(value) ? "none" : rounded(value, summary_digits);
}

std::string bound_words(BoundState bound) {
  switch (bound) {
    case BoundState::free:
      return "";
    case BoundState::at_low:
      return "at the lower bound";
    case BoundState::at_high:
      return "at the upper bound";
  }
  return "";
}

std::string wanted_words(const FoundRequirement& one) {
  if (one.tolerance > 0)
    return rounded(one.wanted, summary_digits) + " +- " + rounded(one.tolerance, 4);
  if (std::isinf(one.wanted)) return one.wanted > 0 ? "none" : "-";
  return (one.is_upper ? "at most " : "at least ") + rounded(one.wanted, summary_digits);
}

std::string parameter_table(const DesignReport& report) {
  std::vector<std::vector<std::string>> rows{{"parameter", "before", "after", "change", "bounds"}};
  for (const FoundParameter& one : report.parameters)
    rows.push_back({one.name, shown_number(one.before), shown_number(one.after),
                    rounded(one.change, summary_digits),
                    rounded(one.low, 6) + " to " + rounded(one.high, 6), bound_words(one.bound)});
  return aligned(rows,
                 {Align::left, Align::right, Align::right, Align::right, Align::left, Align::left},
                 summary_indent);
}

std::string requirement_table(const DesignReport& report) {
  std::vector<std::vector<std::string>> rows{{"requirement", "wanted", "before", "after"}};
  for (const FoundRequirement& one : report.requirements)
    rows.push_back({one.name, wanted_words(one), shown_number(one.before), shown_number(one.after),
                    one.holds               ? ""
                    : std::isnan(one.after) ? "not known"
                                            : "NOT MET",
                    one.limits ? "decides" : ""});
  return aligned(rows,
                 {Align::left, Align::left, Align::right, Align::right, Align::left, Align::left},
                 summary_indent);
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace

std::string design_lines(const DesignReport& report) {
  std::string text =
      summary_line("design", report.message + (report.verified ? "; traced again" : ""));
  text += summary_line("search", counted(report.designs, "design") + " traced");
  return text + parameter_table(report) + requirement_table(report);
}

Json design_json(const DesignReport& report) {
  Json json = {{"status", to_string(report.status)},
               {"message", report.message},
               {"verified", report.verified},
               {"change", report.change},
               {"optimality", finite(report.optimality)},
               {"designs", report.designs},
               {"limits", report.limits}};
  json["parameters"] = Json::array();
  for (const FoundParameter& one : report.parameters)
    json["parameters"].push_back({{"name", one.name},
                                  {"before", one.before},
                                  {"after", one.after},
                                  {"change", one.change},
                                  {"low", one.low},
                                  {"high", one.high},
                                  {"bound", bound_words(one.bound)}});
  json["requirements"] = Json::array();
  for (const FoundRequirement& one : report.requirements)
    json["requirements"].push_back({{"name", one.name},
                                    {"wanted", finite(one.wanted)},
                                    {"is_upper", one.is_upper},
                                    {"tolerance", one.tolerance},
                                    {"before", finite(one.before)},
                                    {"after", finite(one.after)},
                                    {"holds", one.holds},
                                    {"limits", one.limits},
                                    {"multiplier", one.multiplier}});
  return json;
}

}  // namespace springfold::io
