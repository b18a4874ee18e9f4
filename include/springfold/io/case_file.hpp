// From a TOML case file to mechanisms and studies. Grammar: docs/case-file.md.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "springfold/analysis/history.hpp"
#include "springfold/analysis/study.hpp"
#include "springfold/drawing/scene.hpp"
#include "springfold/io/plot_look.hpp"

namespace springfold::io {

/// All mistakes of a case, each one as "file:line:col: key: what is wrong, what is needed [unit]".
class CaseError : public std::runtime_error {
 public:
  explicit CaseError(std::vector<std::string> messages);
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// Labels of the case's units, for tables and plots only: nothing is converted.
struct UnitLabels {
  std::string length = "m";
  std::string force = "N";
  std::map<std::string, std::string> parameters{};  ///< of those parameters that have one
};

/// Where a part of the case stands: "start.pose", "until.lambda", "chain.leg_x", "body.tool" and
/// "case.toml:40:9: study[1].start.pose".
struct PartPlace {
  std::string part{};
  std::string place{};
};

/// When a compared value holds.
enum class Agreement {
  equal,     ///< |ours - expected| <= tolerance
  at_least,  ///< ours >= expected - tolerance
  at_most,   ///< ours <= expected + tolerance
};

/// A value by which one special point is picked out of several.
struct NearValue {
  std::string quantity{};
  double value = 0;
};

/// An entry of the platform's stiffness matrix or of its inverse.
struct MatrixEntry {
  bool is_compliance = false;
  Index row = 0, column = 0;
};

/// On which side of a special point a value is taken. Unsaid: slopes on leaving it, others at the point
/// itself, which at a switching is the side on which the curve arrives.
enum class Side { unsaid, before, after };

/// A published or closed-form value that a run is compared with.
struct ExpectedValue {
  std::string name{};   ///< as printed: "rho at Q1, Kv = 0.01"
  std::string group{};  ///< heading under which it is printed
  std::string study{};
  int run = 1;
  std::string at =
      "start";  ///< "start", "end", an event label such as "LP1", "target 5", or a code
                ///< such as "UZ" or "row": then `near` says which
  std::vector<NearValue> near{};
  std::string quantity{};  ///< a quantity name, "count.LP", "K.x.y", "corank", "ways", ...
  std::optional<MatrixEntry> entry{};  ///< which one "K.x.y" or "C.x.y" means
  std::string per{};                   ///< not empty: the slope d(quantity)/d(per) along the branch
  Side side = Side::unsaid;            ///< of a special point
  double expected = 0;
  double tolerance = 0;  ///< absolute
  Agreement agreement = Agreement::equal;
  double factor = 1;  ///< compared value = factor * quantity
  std::string source{};
};

/// One study with one set of parameter values.
struct PlannedRun {
  std::string study{};
  int run = 1;                   ///< 1, 2, ... along the study's `vary` list
  std::string label{};           ///< "Kv = 0.01", or empty
  bool has_given_label = false;  ///< the label is a text of the case: vary.labels
  model::Mechanism mechanism{};
  analysis::Study plan{};
  std::optional<analysis::ParameterFamily> family{};  ///< control mode parameter
  analysis::History history{};                        ///< the studies before it: start.from
  std::map<std::string, double> parameters{};         ///< all named parameters as used
  std::string driven_parameter{};  ///< control mode parameter: whose value lambda is
  std::vector<PartPlace>
      places{};  ///< of the study's keys, bodies and chains; "": the study itself
  /// What is looked up for its row of the sweep's table; `expected` and `tolerance` mean nothing.
  std::vector<ExpectedValue> columns{};
  bool keeps_curves = true;                          ///< false: only that row is kept
  std::map<std::string, drawing::Member> members{};  ///< names of bars: drawn as such, not as coils
  std::vector<std::string>
      varied{};  ///< names of the parameters that its study varies from run to run
};

/// A study with one row of a table for every run.
struct SweepTable {
  std::string study{};
  std::vector<std::string> parameters{};  ///< that differ from run to run
  std::vector<std::string> columns{};     ///< names of PlannedRun::columns
};

/// One curve (or several) of a figure.
struct PlotCurves {
  std::string study{};
  std::vector<int> runs{};            ///< empty: all of the study
  std::vector<std::string> labels{};  ///< one per run; empty: the runs' own labels
};

struct PlotSpec {
  std::string name{};  ///< file name without ending
  std::string title{};
  std::string x = "deflection", y = "force";  ///< quantity names
  std::string x_label{}, y_label{};           ///< empty: made from quantity and unit
  double x_factor = 1, y_factor = 1;          ///< plotted value = factor * quantity
  bool markup =
      false;  ///< its texts are in the markup of gnuplot; false: they are drawn as they stand
  bool polar =
      false;  ///< the plotted x is an angle [rad], the plotted y the distance from the origin
  std::vector<PlotCurves> curves{};
  std::vector<std::string> more_y{};  ///< further quantities over the same x
  bool shade =
      false;  ///< loads below the first critical one are shaded: studies of kind critical_load
  PlotLook look{};
};

/// One map of a figure.
struct MapPanelSpec {
  std::string study{};
  int run = 1;
  std::string title{};
  int slice = 1;  ///< maps of three axes: number of the value of the third one
};

/// A figure of maps side by side with one colour scale.
struct MapPlotSpec {
  std::string name{};  ///< file name without ending
  std::string title{};
  std::string quantity{};            ///< name of a column of all its maps
  std::string label{};               ///< of the colours; empty: from quantity and unit
  std::string x_label{}, y_label{};  ///< empty: from the axes
  double factor = 1;                 ///< shown value = factor * quantity
  double x_factor = 1, y_factor = 1;
  std::vector<double> levels{};  ///< contour lines; empty: about ten round numbers
  std::optional<std::pair<double, double>> range{};  ///< of the colours; none: all that occurs
  bool activation = true;                            ///< lines at which springs switch
  bool markup = false;                               ///< as PlotSpec::markup
  std::vector<MapPanelSpec> panels{};
  SheetLook look{};
};

/// A figure of relative sensitivities of one special point, largest first.
struct TornadoSpec {
  std::string name{};  ///< file name without ending
  std::string title{};
  std::string study{};  ///< of kind sensitivity
  int run = 1;
  std::string at{};                 ///< label of the special point: "LP1"
  std::string quantity = "lambda";  ///< whose sensitivities
  std::string label{};              ///< below the bars; empty: made from the quantity
  bool markup = false;              ///< as PlotSpec::markup
  SheetLook look{};
};

/// A posture of a picture.
struct PostureSpec {
  std::string study{};
  /// Of a special point or an equilibrium ("LP1", "EQ2"); "start", "end"; "guess": as the case gives it;
  /// "all": the start and all special points.
  std::string label{};
};

/// A picture of the mechanism: one posture, or several side by side.
struct PictureSpec {
  std::string name{};        ///< file name without ending
  std::string title{};       ///< empty: the case's
  std::vector<int> runs{1};  ///< of every study that is named
  std::vector<PostureSpec> postures{};
  std::string view{};  ///< "xy", "xz", "yz", "perspective"; empty: as drawing::natural_view
  std::string colour = "stability";         ///< also "force", "energy", "none"
  std::vector<std::string> formats{"svg"};  ///< also "png"
};

struct Expectations {
  std::vector<ExpectedValue> values{};
  std::vector<std::string> notes{};  ///< printed below the table
};

/// A node of the case, for listings: a point body, or a named point of the base.
struct CaseNode {
  std::string name{};
  bool moves = true;                 ///< false: fixed in all directions
  std::vector<std::string> fixed{};  ///< directions in which it is held: "x", "y", "z"
};

struct Case {
  std::filesystem::path file{};
  std::string title{};
  UnitLabels units{};
  std::vector<PlannedRun> runs{};
  std::vector<SweepTable> sweeps{};
  std::vector<PlotSpec> plots{};
  std::vector<MapPlotSpec> map_plots{};
  std::vector<TornadoSpec> tornados{};
  std::vector<PictureSpec> pictures{};
  bool wants_report = false;  ///< [report]: every run writes the HTML page
  Expectations expected{};
  std::string hash{};  ///< of the bytes of all files read and the overrides
  std::map<std::string, std::string> overrides{};
  std::vector<CaseNode> nodes{};     ///< fixed ones first
  std::vector<std::string> bars{};   ///< names of the line springs that the case calls bars
  std::vector<std::string> hints{};  ///< what is allowed and seldom meant, each with its place
};

/// Reads and checks everything. `overrides` maps parameter names to numbers or formulas.
/// @throws CaseError with all mistakes of the stage at which it stopped
Case load_case(const std::filesystem::path& file,
               const std::map<std::string, std::string>& overrides = {});

}  // namespace springfold::io
