#include <algorithm>
#include <set>

#include "case_draft.hpp"
#include "case_hints.hpp"
#include "compared_quantity.hpp"
#include "figure.hpp"
#include "flat_shapes.hpp"
#include "further_curves.hpp"
#include "history_rules.hpp"
#include "hold_draft.hpp"
#include "jump_access.hpp"
#include "memory_limits.hpp"
#include "model_problem.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

/// Gives a sentence of analysis::problems_in, "start.solve: ...", the place of that key in the file.
void add_study_problem(const std::string& text, const StudyDraft& study, int run,
                       Problems& problems) {
  const std::size_t colon = text.find(": ");
  if (colon == std::string::npos)
    return problems.add(study.place, study.key, text, study.when(run));
  const std::string key = study.key + "." + text.substr(0, colon);
  const std::string what = text.substr(colon + 2), when = study.when(run);
  std::string name = text.substr(0, colon);
  while (!name.empty()) {
    const auto has_name = [&name](const NamedPlace& entry) { return entry.name == name; };
    const auto entry = std::find_if(study.entries.begin(), study.entries.end(), has_name);
    if (entry != study.entries.end()) return problems.add(entry->place, key, what, when);
    const std::size_t dot = name.rfind('.');
    name.resize(dot == std::string::npos ? 0 : dot);
  }
  problems.add(study.place, key, what, when);
}

void check_quantity(const NamedPlace& quantity, const std::vector<std::string>& known,
                    const StudyDraft& study, Problems& problems) {
  if (quantity.name.empty()) return;
  if (std::find(known.begin(), known.end(), quantity.name) != known.end()) return;
  problems.add(quantity.place, quantity.key,
               "no quantity \"" + quantity.name + "\" in study \"" + study.name + "\"" +
                   suggestion(quantity.name, known));
}

class Builder {
 public:
  Builder(std::shared_ptr<const CaseDraft> draft, Problems& problems)
      : draft_{std::move(draft)}, problems_{problems} {
    names_.resize(draft_->studies.size());
  }

  Case build() {
    result_.title = draft_->title;
    result_.units = draft_->units;
    result_.wants_report = draft_->wants_report;
    list_nodes(draft_->mechanism, result_);
    for (std::size_t i = 0; i < draft_->studies.size(); ++i)
      for (int run = 1; run <= draft_->studies[i].runs(); ++run) add_run(i, run);
    add_plots();
    add_map_plots();
    add_expectations();
    return std::move(result_);
  }

 private:
  Values parameters_of(std::size_t i, int run) {
    return evaluate(draft_->parameters, draft_->studies[i].changes(run), draft_->book, "",
                    problems_);
  }

  /// Mechanism and study of one run.
  PlannedRun plan_of(std::size_t i, int run, const std::vector<double>& of_mechanism,
                     const std::vector<double>& numbers, const Values& parameters) {
    const StudyDraft& study = draft_->studies[i];
    PlannedRun planned{.study = study.name, .run = run};
    planned.label = label_of(study, run, parameters);
    planned.has_given_label = study.vary && !study.vary->labels.empty();
    if (study.vary)
      for (const std::size_t p : study.vary->parameters)
        planned.varied.push_back(draft_->parameters[p].name);
    planned.mechanism = build_mechanism(draft_->mechanism, of_mechanism);
    planned.members = members_of(draft_->mechanism);
    for (model::Load& load : build_loads(study.loads, numbers))
      planned.mechanism.loads.push_back(std::move(load));
    const auto body = static_cast<std::size_t>(study.body - 1);
    planned.plan =
        build_study(study, draft_->mechanism.bodies[body].task_space, numbers, draft_->parameters);
    add_holds(study.history, planned.mechanism);
    planned.history = history_of(study.history, draft_->mechanism);
    if (study.critical.study)
      begin_on_curve(*study.critical.study, run, planned);
    else if (study.history.study)
      planned.history.earlier = earlier_of(i, run, parameters);
    for (std::size_t p = 0; p < draft_->parameters.size(); ++p)
      planned.parameters[draft_->parameters[p].name] = parameters.values[p];
    if (study.control == analysis::ControlMode::parameter && study.parameter) {
      planned.family = family_of(draft_, i, run, parameters);
      planned.driven_parameter = draft_->parameters[*study.parameter].name;
    }
    return planned;
  }

  /// The study in whose state this one starts: the run with the same number, or its only one.
  std::shared_ptr<const analysis::Earlier> earlier_of(std::size_t i, int run,
                                                      const Values& parameters) {
    const HistoryDraft& history = draft_->studies[i].history;
    const StudyDraft& before = draft_->studies[*history.study];
    const int run_before = before.runs() == 1 ? 1 : run;
    const Values own = parameters_of(*history.study, run_before);
    PlannedRun planned = plan_of(*history.study, run_before,
                                 draft_->mechanism.numbers.values(draft_->book, own).values,
                                 before.numbers.values(draft_->book, own).values, own);
    analysis::Earlier earlier{.mechanism = std::move(planned.mechanism),
                              .study = std::move(planned.plan),
                              .family = std::move(planned.family),
                              .history = std::move(planned.history)};
    earlier.at = history.at;
    earlier.keeps_loads = history.keeps_loads;
    earlier.common_loads = draft_->mechanism.loads.size();
    earlier.parameter = before.parameter.value_or(0);
    earlier.cases = cases_of(draft_, i, run, parameters);
    earlier.own_cases = cases_of(draft_, *history.study, run_before, own);
    return std::make_shared<const analysis::Earlier>(std::move(earlier));
  }

  /// The study at a row of whose critical curve this one begins, with the same history.
  void begin_on_curve(std::size_t i, int run, PlannedRun& planned) {
    const StudyDraft& before = draft_->studies[i];
    const Values own = parameters_of(i, run);
    PlannedRun earlier = plan_of(i, run, draft_->mechanism.numbers.values(draft_->book, own).values,
                                 before.numbers.values(draft_->book, own).values, own);
    earlier.plan.critical.cases = cases_of(draft_, i, run, own);
    std::vector<std::string>& held = planned.plan.critical.parameters;
    held = {earlier.plan.critical.parameter};
    held.insert(held.end(), earlier.plan.critical.parameters.begin(),
                earlier.plan.critical.parameters.end());
    std::erase(held, planned.plan.critical.parameter);
    planned.history.earlier = std::make_shared<const analysis::Earlier>(
        analysis::Earlier{.mechanism = std::move(earlier.mechanism),
                          .study = std::move(earlier.plan),
                          .history = std::move(earlier.history),
                          .at = curve_row(planned.plan.critical.point)->label});
  }

  void add_run(std::size_t i, int run) {
    const StudyDraft& study = draft_->studies[i];
    const Values parameters = parameters_of(i, run);
    const std::vector<double> numbers = study.numbers.values(draft_->book, parameters).values;
    const std::vector<double> of_mechanism =
        draft_->mechanism.numbers.values(draft_->book, parameters).values;
    PlannedRun planned = plan_of(i, run, of_mechanism, numbers, parameters);
    if (study.control == analysis::ControlMode::parameter && study.parameter)
      check_segments(i, run);
    planned.plan.map.situation = situations_of(draft_, i, run);
    if (analysis::is_of_critical_points(study.kind))
      planned.plan.critical.cases = cases_of(draft_, i, run, parameters);
    planned.places = places_of(study, draft_->mechanism);
    if (!check(planned, of_mechanism, i)) return;
    if (run == 1) {
      const RunValues values{parameters, of_mechanism, numbers};
      add_hints(*draft_, i, values, planned.mechanism, result_.hints);
    }
    result_.runs.push_back(std::move(planned));
    if (study.vary) add_columns(i, parameters);
  }

  /// What the last run has in its sweep's table.
  void add_columns(std::size_t i, const Values& parameters) {
    const VaryDraft& vary = *draft_->studies[i].vary;
    PlannedRun& planned = result_.runs.back();
    planned.keeps_curves = vary.keeps_curves;
    for (const ExpectedDraft& column : vary.columns)
      planned.columns.push_back(wanted(column, i, planned.run, parameters));
    if (vary.columns.empty() || planned.run != 1) return;
    SweepTable table{.study = planned.study};
    for (const std::size_t p : vary.parameters)
      table.parameters.push_back(draft_->parameters[p].name);
    for (const ExpectedValue& column : planned.columns) table.columns.push_back(column.name);
    result_.sweeps.push_back(std::move(table));
  }

  /// How many links a link is cut into cannot change along a branch.
  void check_segments(std::size_t i, int run) {
    const StudyDraft& study = draft_->studies[i];
    std::vector<bool> moves(draft_->parameters.size(), false);
    moves[*study.parameter] = true;
    for (const Update& update :
         dependents_of(*study.parameter, draft_->parameters, study.changes(run), draft_->book))
      moves[update.target] = true;
    for (const Update& update : draft_->mechanism.numbers.updates_for(moves, draft_->book))
      for (const ChainDraft& chain : draft_->mechanism.chains)
        for (const ElementDraft& element : chain.elements)
          if (const auto* link = std::get_if<ElasticDraft>(&element.content);
              link && link->segments == update.target) {
            const Definition& at = draft_->mechanism.numbers.definition(link->segments);
            problems_.add(at.place, at.key,
                          "the number of segments cannot depend on the parameter of study \"" +
                              study.name + "\"");
          }
  }

  std::string label_of(const StudyDraft& study, int run, const Values& parameters) const {
    if (!study.vary) return {};
    if (!study.vary->labels.empty()) return study.vary->labels[static_cast<std::size_t>(run - 1)];
    std::string label;
    for (const std::size_t p : study.vary->parameters)
      label += (label.empty() ? "" : ", ") + draft_->parameters[p].name + " = " +
               rounded(parameters.values[p], 12);
    return label;
  }

  /// Rules of model and analysis; names of quantities once per study.
  bool check(const PlannedRun& planned, const std::vector<double>& numbers, std::size_t i) {
    const StudyDraft& study = draft_->studies[i];
    const std::size_t before = problems_.size();
    check_bars(draft_->mechanism, numbers, planned.mechanism, study.when(planned.run), problems_);
    if (problems_.size() != before) return false;
    for (const std::string& text : model::problems_in(planned.mechanism))
      add_model_problem(text, draft_->mechanism, numbers, study, planned.run, problems_);
    if (problems_.size() != before) return false;
    check_planes(draft_->mechanism, numbers, planned.mechanism, study.when(planned.run), problems_);
    check_flat_folds(draft_->mechanism, planned.mechanism, study.when(planned.run), problems_);
    check_names(planned, i);
    for (const std::string& text : analysis::problems_in(planned.plan, planned.mechanism)) {
      const bool has_better_place = text.find(": no quantity ") != std::string::npos;
      if (!has_better_place) add_study_problem(text, study, planned.run, problems_);
    }
    if (const std::string text = history_problem(study.history, draft_->mechanism, planned);
        !text.empty())
      add_study_problem(text, study, planned.run, problems_);
    return problems_.size() == before;
  }

  /// Runs have the same names, unless a parameter sets the number of segments of a link.
  void check_names(const PlannedRun& planned, std::size_t i) {
    const StudyDraft& study = draft_->studies[i];
    std::vector<std::string> names = analysis::quantity_names(planned.plan, planned.mechanism);
    const bool seen_before =
        std::find(names_[i].begin(), names_[i].end(), names) != names_[i].end();
    names_[i].resize(static_cast<std::size_t>(study.runs()));
    names_[i][static_cast<std::size_t>(planned.run - 1)] = names;
    rows_.add(planned, names.size(), study, problems_);
    if (seen_before) return;
    std::set<std::string> seen;
    for (const std::string& name : names)
      if (!seen.insert(name).second)
        problems_.add(
            study.place, study.key,
            "two quantities are called \"" + name + "\": rename a body, chain, joint or parameter");
    for (const LimitDraft& limit : study.until)
      check_quantity(limit.quantity, names, study, problems_);
    for (const MarkDraft& mark : study.marks)
      check_quantity(mark.quantity, names, study, problems_);
    for (const NamedPlace& quantity : study.extrema)
      check_quantity(quantity, names, study, problems_);
    for (const LimitDraft& side : study.box) check_quantity(side.quantity, names, study, problems_);
  }

  /// Names are known only if the run could be built.
  void check_use(const NamedPlace& quantity, std::size_t study, int run) {
    const auto r = static_cast<std::size_t>(run - 1);
    if (r < names_[study].size() && !names_[study][r].empty())
      check_quantity(quantity, names_[study][r], draft_->studies[study], problems_);
  }

  /// @param what  shows them: `plot "force"`
  void check_curves(const std::string& what, std::size_t i) {
    const StudyDraft& study = draft_->studies[i];
    if (study.vary && !study.vary->keeps_curves)
      problems_.add(study.place, study.key + ".vary.curves",
                    "got false, need true: " + what + " draws these curves");
  }

  /// "K.x.y" and "C.x.y"; nothing for all other names.
  std::optional<MatrixEntry> entry_of(const NamedPlace& quantity, std::size_t study) const {
    if (!quantity.name.starts_with("K.") && !quantity.name.starts_with("C.")) return std::nullopt;
    const auto run = std::find_if(
        result_.runs.begin(), result_.runs.end(),
        [&](const PlannedRun& planned) { return planned.study == draft_->studies[study].name; });
    if (run == result_.runs.end()) return std::nullopt;
    for (const MatrixEntryName& known : matrix_entries(run->mechanism))
      if (known.name == quantity.name) return known.entry;
    return std::nullopt;
  }

  void add_plots() {
    const Values parameters = evaluate(draft_->parameters, {}, draft_->book, "", problems_);
    for (const PlotDraft& plot : draft_->plots) {
      const std::vector<double> numbers = plot.numbers.values(draft_->book, parameters).values;
      PlotSpec spec = plot.spec;
      spec.x_factor = numbers[plot.x_factor];
      spec.y_factor = numbers[plot.y_factor];
      set_numbers(plot.look, numbers, spec.look);
      for (const PlotCurves& curves : spec.curves)
        for (std::size_t i = 0; i < draft_->studies.size(); ++i) {
          if (draft_->studies[i].name != curves.study) continue;
          check_curves("plot \"" + spec.name + "\"", i);
          if (!is_over_parameter(spec)) check_use(plot.x, i, 1);
          if (is_in_plane(spec)) continue;
          for (const NamedPlace& y : plot.y) check_use(y, i, 1);
        }
      result_.plots.push_back(std::move(spec));
    }
  }

  void add_map_plots() {
    const Values parameters = evaluate(draft_->parameters, {}, draft_->book, "", problems_);
    for (const MapPlotDraft& plot : draft_->map_plots) {
      const std::vector<double> numbers = plot.numbers.values(draft_->book, parameters).values;
      MapPlotSpec spec = plot.spec;
      spec.factor = numbers[plot.factor];
      spec.x_factor = numbers[plot.x_factor];
      spec.y_factor = numbers[plot.y_factor];
      set_numbers(plot.look, numbers, spec.look);
      for (const NumberId level : plot.levels) spec.levels.push_back(numbers[level]);
      if (!plot.range.empty()) spec.range = {numbers[plot.range[0]], numbers[plot.range[1]]};
      for (const MapPanelSpec& panel : spec.panels)
        for (std::size_t i = 0; i < draft_->studies.size(); ++i)
          if (draft_->studies[i].name == panel.study) check_use(plot.quantity, i, panel.run);
      result_.map_plots.push_back(std::move(spec));
    }
    for (const TornadoDraft& tornado : draft_->tornados) {
      if (tornado.study) check_use(tornado.quantity, *tornado.study, tornado.spec.run);
      TornadoSpec spec = tornado.spec;
      set_numbers(tornado.look, tornado.numbers.values(draft_->book, parameters).values, spec.look);
      result_.tornados.push_back(std::move(spec));
    }
    for (const PictureDraft& picture : draft_->pictures) {
      for (const std::size_t i : picture.studies)
        check_curves("picture \"" + picture.spec.name + "\"", i);
      result_.pictures.push_back(picture.spec);
    }
  }

  void add_expectations() {
    result_.expected.notes = draft_->notes;
    for (const ExpectedDraft& draft : draft_->expected) {
      const StudyDraft& study = draft_->studies[*draft.study];
      const int run = draft.value.run;
      const Values parameters =
          evaluate(draft_->parameters, study.changes(run), draft_->book, "", problems_);
      const std::vector<double> numbers = draft.numbers.values(draft_->book, parameters).values;
      ExpectedValue value = wanted(draft, *draft.study, run, parameters);
      value.expected = numbers[draft.expected];
      value.tolerance = numbers[draft.tolerance];
      result_.expected.values.push_back(std::move(value));
    }
  }

  /// What is looked up in a run, with its numbers; names of quantities are checked.
  ExpectedValue wanted(const ExpectedDraft& draft, std::size_t study, int run,
                       const Values& parameters) {
    const std::vector<double> numbers = draft.numbers.values(draft_->book, parameters).values;
    ExpectedValue value = draft.value;
    value.study = draft_->studies[study].name;
    value.run = run;
    value.factor = numbers[draft.factor];
    for (const NearDraft& near : draft.near) {
      NamedPlace column = near.quantity;
      if (value.at == "J") column.name = jump_column(column.name);
      check_use(column, study, run);
      value.near.push_back({near.quantity.name, numbers[near.value]});
    }
    check_use(draft.per, study, run);
    value.entry = entry_of(draft.quantity, study);
    if (!value.entry) check_use(draft.quantity, study, run);
    return value;
  }

  std::shared_ptr<const CaseDraft> draft_;
  Problems& problems_;
  std::vector<std::vector<std::vector<std::string>>> names_{};  ///< quantities of every run
  RowCounter rows_{};
  Case result_{};
};

}  // namespace

Case build_case(std::shared_ptr<const CaseDraft> draft, Problems& problems) {
  return Builder{std::move(draft), problems}.build();
}

}  // namespace springfold::io
