// `animate` moves the mechanism along the rows of a branch.
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "cli/exit_code.hpp"
#include "cli/run_main.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/film.hpp"
#include "springfold/io/postures.hpp"
#include "springfold/io/read_case.hpp"

namespace springfold::cli {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Le;
using testing::Not;
using testing::SizeIs;

class Animate : public testing::Test {
 protected:
  int run(std::vector<std::string> words, const std::string& text = small_case()) {
    put_text(scratch.path() / "case.toml", text);
    words.insert(words.begin(), {"springfold", "animate"});
    words.insert(words.end(),
                 {(scratch.path() / "case.toml").string(), "--output", file().string()});
    std::vector<const char*> argv;
    for (const auto& word : words) argv.push_back(word.c_str());
    std::ostringstream out, messages;
    const int code = run_main(static_cast<int>(argv.size()), argv.data(), out, messages);
    err = messages.str();
    return code;
  }
  std::filesystem::path file() const { return scratch.path() / "movie.svg"; }
  std::string movie() const {
    std::ostringstream text;
    text << std::ifstream{file()}.rdbuf();
    return text.str();
  }
  std::vector<std::string> frames() const {
    const std::string text = movie();
    std::vector<std::string> list;
    for (auto at = text.find("<g class"); at != std::string::npos; at = text.find("<g class", at)) {
      const auto end = text.find("</g>", at);
      list.push_back(text.substr(at, end - at));
      at = end;
    }
    return list;
  }
  ScratchFolder scratch{};
  std::string err{};
};

/// The last number of the frame's note "force = 0.2 N".
double note(const std::string& frame, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(frame, found, std::regex{name + " = (-?[0-9.e-]+)"})) return NAN;
  return std::stod(found[1]);
}

/// The moving dot: the last circle.
double dot_x(const std::string& frame) {
  const auto at = frame.rfind("<circle cx=\"") + 12;
  return std::stod(frame.substr(at));
}

TEST_F(Animate, HasAsManyFramesAsAreWanted) {
  for (const int wanted : {2, 10, 60}) {
    EXPECT_EQ(run({"--frames", std::to_string(wanted)}), all_done);
    // The start is one of three special points of the way, whose rows may take the place of others.
    EXPECT_THAT(frames(), SizeIs(AllOf(Ge(2U), Le(static_cast<std::size_t>(wanted)))));
    EXPECT_THAT(frames(), SizeIs(Ge(static_cast<std::size_t>(wanted) * 9 / 10)));
  }
}

TEST_F(Animate, TheDotMovesWithTheValuesOfTheRows) {
  EXPECT_EQ(run({}), all_done);
  const auto all = frames();
  ASSERT_THAT(all, SizeIs(Ge(50U)));
  EXPECT_EQ(note(all.front(), "deflection"), -0.1);
  EXPECT_EQ(note(all.back(), "deflection"), 0.3);
  const double left = dot_x(all.front()), right = dot_x(all.back());
  for (const std::string& frame : all) {
    const double deflection = note(frame, "deflection");
    EXPECT_NEAR(note(frame, "force"), 2 * deflection, 2e-5);  // the spring of stiffness 2
    constexpr double rounding = 0.02;                         // pixels, and five digits of the note
    EXPECT_NEAR(dot_x(frame), left + (right - left) * (deflection + 0.1) / 0.4, rounding);
  }
}

TEST_F(Animate, FramesAreAtEvenArcLengthOnAStraightWay) {
  EXPECT_EQ(run({"--frames", "41", "--from", "start"}), all_done);
  const auto all = frames();
  ASSERT_THAT(all, SizeIs(Ge(38U)));
  for (std::size_t i = 1; i < all.size();
       ++i)  // rows lie at most half a step from where they belong
    EXPECT_LE(note(all[i], "deflection") - note(all[i - 1], "deflection"), 2 * 0.3 / 40 + 1e-5);
}

TEST_F(Animate, GoesFromPointToPointAlsoBackwards) {
  EXPECT_EQ(run({"--from", "EP2", "--to", "start"}), all_done);
  EXPECT_EQ(note(frames().front(), "deflection"), 0.3);
  EXPECT_EQ(note(frames().back(), "deflection"), 0);
}

TEST_F(Animate, NamesTheLabelsThereAreForOneThatIsNot) {
  EXPECT_EQ(run({"--to", "LP7"}), wrong_usage);
  EXPECT_THAT(err, HasSubstr("there is no point \"LP7\" on branch 1 of push; there are: "
                             "start, EP1, EP2, end"));
  EXPECT_EQ(run({"--mode", "EP1"}), wrong_usage);
  EXPECT_THAT(err, HasSubstr("no limit point or branch point \"EP1\" with a mode on branch 1 "
                             "of push; there are: none"));
  EXPECT_EQ(run({"--study", "pull"}), wrong_usage);
  EXPECT_EQ(run({"--run", "2"}), wrong_usage);
  EXPECT_THAT(err, HasSubstr("there is no run 2"));
  EXPECT_EQ(run({"--branch", "2"}), wrong_usage);
  EXPECT_THAT(err, HasSubstr("there is no branch 2 of push; there are 1"));
  EXPECT_EQ(run({"--branch", "0"}), wrong_usage);
  EXPECT_THAT(err, HasSubstr("need a whole number from 1 on"));
  EXPECT_EQ(run({"--study", "rest"}), wrong_usage);
  EXPECT_THAT(err, HasSubstr("single posture"));
  EXPECT_EQ(run({"--mode", "LP1", "--from", "EP1"}), wrong_usage);
  EXPECT_EQ(run({"--frames", "1"}), wrong_usage);
  EXPECT_THAT(movie(), IsEmpty());
}

TEST_F(Animate, TextsOfTheCaseAreText) {
  std::string text = small_case();
  const std::string title = "A point on two springs";
  text.replace(text.find(title), title.size(), R"(</style><script>alert(1)</script> \"; x)");
  EXPECT_EQ(run({}, text), all_done);
  EXPECT_THAT(movie(), Not(HasSubstr("<script>")));
  EXPECT_THAT(movie(), HasSubstr("&lt;/style&gt;&lt;script&gt;alert(1)&lt;/script&gt; &quot;; x"));
}

/// The planar Orthoglide pushed from Q2 through its flat singularity.
class OrthoglideFilm : public testing::Test {
 protected:
  OrthoglideFilm() {
    for (const auto& planned : the_case.runs)
      if (planned.study == "Q2" && planned.run == 1) run = &planned;
  }
  analysis::StudyResult result_of(const io::PlannedRun& planned) const {
    return analysis::run_study(planned.mechanism, planned.plan, nullptr, {});
  }
  io::Case the_case = io::load_case(std::filesystem::path{SPRINGFOLD_SOURCE_DIR} /
                                    "cases/orthoglide-planar/case.toml");
  const io::PlannedRun* run = nullptr;
};

double largest_difference(const drawing::Scene& a, const drawing::Scene& b) {
  double largest = a.points.size() == b.points.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < a.points.size() && i < b.points.size(); ++i)
    largest = std::max(largest, (a.points[i] - b.points[i]).norm());
  return largest;
}

TEST_F(OrthoglideFilm, FramesOfSpecialPointsHaveThePosturesThatAreDrawnThere) {
  ASSERT_NE(run, nullptr);
  const auto result = result_of(*run);
  const auto fine = io::with_rows_for({}, *run, result);
  const auto outcome = io::film_of(fine, result_of(fine), the_case.units, {});
  EXPECT_EQ(outcome.problem, "");
  const io::RowScenes scenes{*run, result};
  for (const std::string label : {"EP1", "LP1", "LP2", "EP2"}) {
    const auto frame =
        std::find_if(outcome.film.frames.begin(), outcome.film.frames.end(),
                     [&](const drawing::Frame& f) { return f.panel.title == label; });
    ASSERT_NE(frame, outcome.film.frames.end()) << label;
    const auto found = io::row_at(result, label);
    const auto drawn = scenes.panel_of(*found.row, label, the_case.units);
    ASSERT_TRUE(drawn) << label;
    EXPECT_LT(largest_difference(frame->panel.scene, drawn->scene), 1e-9) << label;
    EXPECT_EQ(outcome.film.diagram.points[frame->point].label, label);
  }
}

TEST_F(OrthoglideFilm, TheModeOfTheLimitPointSwingsAboutItsPostureAlongTheDiagonal) {
  ASSERT_NE(run, nullptr);
  const auto result = result_of(*run);
  const auto outcome = io::film_of(*run, result, the_case.units, {.mode = "LP1"});
  ASSERT_EQ(outcome.problem, "");
  const auto& first = outcome.film.frames.front().panel.scene;
  const auto& last = outcome.film.frames.back().panel.scene;
  const auto at = io::RowScenes{*run, result}.scene_of(*io::row_at(result, "LP1").row);
  ASSERT_TRUE(at);
  for (std::size_t i = 0; i < first.points.size(); ++i)
    EXPECT_LT((0.5 * (first.points[i] + last.points[i]) - at->points[i]).norm(), 1e-12);
  const auto tool = first.bodies.front().origin;
  const auto way = last.points[tool] - first.points[tool];
  EXPECT_GT(way.norm(), 0.01 * drawing::size_of(first));
  EXPECT_NEAR(way.x(), way.y(), 1e-6 * way.norm());  // the mechanism is symmetric about it
}

/// The column of three links: its straight branch, and three pairs that leave it.
class ColumnFilm : public testing::Test {
 protected:
  /// Is each frame the posture of its row of this branch?
  void expect_rows_of(std::size_t number, const io::FilmWish& wish) {
    const auto outcome = io::film_of(planned, result, the_case.units, wish);
    ASSERT_EQ(outcome.problem, "");
    const analysis::Branch& branch = result.branches.at(number - 1);
    EXPECT_THAT(outcome.film.diagram.points, SizeIs(branch.samples.size()));
    const io::RowScenes scenes{planned, result};
    for (const drawing::Frame& frame : outcome.film.frames) {
      const auto at = scenes.scene_of(branch.samples.at(frame.point));
      ASSERT_TRUE(at);
      EXPECT_EQ(largest_difference(frame.panel.scene, *at), 0);
    }
  }
  io::Case the_case =
      io::load_case(std::filesystem::path{SPRINGFOLD_SOURCE_DIR} / "cases/link-column/case.toml");
  const io::PlannedRun& planned = the_case.runs.front();
  analysis::StudyResult result = analysis::run_study(planned.mechanism, planned.plan, nullptr, {});
};

TEST_F(ColumnFilm, GoesAlongTheBranchThatIsNamed) {
  for (std::size_t number = 1; number <= result.branches.size(); ++number)
    expect_rows_of(number, {.branch = static_cast<int>(number)});
}

TEST_F(ColumnFilm, GoesAlongTheBranchThatHasTheLabel) {
  const analysis::Branch& third = result.branches.at(2);
  expect_rows_of(3, {.to = third.events.back().label});
}

TEST(SymmetricFilm, ADeflectionThatIsZeroButForRoundingIsNoAxis) {
  const io::Case the_case =
      io::load_case(std::filesystem::path{SPRINGFOLD_SOURCE_DIR} / "cases/rpr-platform/case.toml");
  for (const auto& run : the_case.runs) {
    if (run.study != "swell") continue;  // the middle position stays where it is
    const auto result = analysis::run_study(run.mechanism, run.plan, &*run.family, {});
    const auto outcome = io::film_of(run, result, the_case.units, {});
    EXPECT_EQ(outcome.problem, "");
    EXPECT_EQ(outcome.film.diagram.x_name, "s");
    EXPECT_EQ(outcome.film.diagram.y_name, "lambda (l0) [m]");
    return;
  }
  FAIL() << "no study \"swell\"";
}

}  // namespace
}  // namespace springfold::cli
