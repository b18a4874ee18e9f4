// Parts of the HTML page that are files of their own, built in by cmake/Report.cmake. Private to io.
#pragma once

#include <string_view>

namespace springfold::io {

/// All empty if the page was left out.
struct ReportAssets {
  std::string_view frame{};    ///< report/page.html
  std::string_view style{};    ///< report/page.css
  std::string_view script{};   ///< report/*.js, ours
  std::string_view d3{};       ///< D3, of others
  std::string_view licence{};  ///< D3's
};

ReportAssets report_assets();

}  // namespace springfold::io
