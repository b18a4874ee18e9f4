#include "springfold/io/report.hpp"

#include <utility>

#include "report_assets.hpp"
#include "report_data.hpp"
#include "springfold/io/shown_text.hpp"

namespace springfold::io {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// The frame with each "@NAME@" replaced once, in the order in which they stand there: what is put in is
/// not looked at again.
std::string filled(std::string_view frame,
                   const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string page;
  for (const auto& [name, text] : parts) {
    const std::size_t at = frame.find(name);
    if (at == std::string_view::npos) continue;
    page += frame.substr(0, at);
    page += text;
    frame.remove_prefix(at + name.size());
  }
  return page += frame;
}

}  // namespace

bool has_report() { return !report_assets().frame.empty(); }

std::string report_html(const Case& the_case, const std::vector<analysis::StudyResult>& results) {
  const ReportAssets assets = report_assets();
  const std::string title = the_case.title.empty() ? "springfold" : the_case.title;
  return filled(assets.frame, {{"@TITLE@", escaped(shown_in_line(title))},
                               {"@STYLE@", std::string(assets.style)},
                               {"@LICENCE@", escaped(assets.licence)},
                               {"@DATA@", report_data(the_case, results)},
                               {"@D3@", std::string(assets.d3)},
                               {"@SCRIPT@", std::string(assets.script)}});
}

}  // namespace springfold::io
