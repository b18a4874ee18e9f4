#include "springfold/drawing/movie.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <regex>

#include "drawing/glyphs.hpp"
#include "drawing/mechanisms.hpp"
#include "drawing/painter.hpp"

namespace springfold::drawing {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

/// Three postures of two links beside a curve of three points.
Film small_film() {
  Film film{.heading = "push",
            .order = {0, 1, 1, 2},
            .diagram = {.x_name = "deflection [m]", .y_name = "force [N]"}};
  const statics::System system = statics::prepare(two_links());
  for (std::size_t i = 0; i < 3; ++i) {
    const double shoulder = 0.5 * static_cast<double>(i);
    film.frames.push_back({{.scene = scene_of(system, posture_of(system, shoulder, 1, 1, 1))}, i});
  }
  film.diagram.points = {{.x = 0, .y = -1}, {.x = 1, .y = 3, .label = "LP1"}, {.x = 4, .y = 1}};
  return film;
}

/// Whether the animation shows a frame at this part of a loop, read from the file's key frames.
bool is_seen(const std::string& svg, std::size_t frame, double part) {
  const std::string name = "@keyframes f" + std::to_string(frame) + "{";
  const auto begin = svg.find(name) + name.size();
  const std::string keys = svg.substr(begin, svg.find('\n', begin) - begin);
  const std::regex key{R"(([0-9.]+)%\{visibility:(visible|hidden)\})"};
  bool seen = false;
  for (std::sregex_iterator it{keys.begin(), keys.end(), key}, end; it != end; ++it)
    if (std::stod((*it)[1]) <= 100 * part) seen = (*it)[2] == "visible";
  return seen;
}

TEST(Movie, ShowsExactlyTheFrameWhoseTimeItIsThereAndBack) {
  const Movie movie = animate(small_film(), {});
  ASSERT_THAT(movie.frames, SizeIs(3));
  const std::string svg = svg_text(movie);
  const auto slots = movie.order.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const double part = (static_cast<double>(slot) + 0.5) / static_cast<double>(slots);
    for (std::size_t frame = 0; frame < 3; ++frame)
      EXPECT_EQ(is_seen(svg, frame, part), movie.order[slot] == frame) << slot << " " << frame;
  }
  // There and back, from the end of the rest at the beginning.
  const auto away =
      std::find_if(movie.order.begin(), movie.order.end(), [](auto i) { return i > 0; });
  const std::vector<std::size_t> way(away - 1, movie.order.end());
  EXPECT_EQ(way, std::vector<std::size_t>(way.rbegin(), way.rend()));
}

TEST(Movie, OnlyTheFirstFrameIsSeenWhereNothingIsAnimated) {
  const std::string svg = svg_text(animate(small_film(), {}));
  EXPECT_THAT(svg, HasSubstr("animation-name:f0\">"));
  EXPECT_THAT(svg, HasSubstr("animation-name:f1\" visibility=\"hidden\">"));
  EXPECT_THAT(svg, HasSubstr("animation-name:f2\" visibility=\"hidden\">"));
}

TEST(Movie, TheDotIsAtTheValuesOfItsFrame) {
  const Film film = small_film();
  const Movie movie = animate(film, {});
  std::vector<Place> dots;
  for (const auto& frame : movie.frames) dots.push_back(std::get<Disc>(frame.back()).centre);
  // Straight axes: a quarter of the way in x, the whole and the half of it in y, which runs up.
  EXPECT_NEAR(dots[1].x - dots[0].x, (dots[2].x - dots[0].x) / 4, 1e-9);
  EXPECT_NEAR(dots[2].y - dots[0].y, (dots[1].y - dots[0].y) / 2, 1e-9);
  EXPECT_GT(dots[2].x, dots[0].x);
  EXPECT_LT(dots[1].y, dots[0].y);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(dots[i].x, place_in_movie(film, film.diagram.points[i]).x);
}

TEST(Movie, AllFramesHaveOneScale) {
  const Movie movie = animate(small_film(), {});
  std::vector<double> lengths;
  for (const auto& frame : movie.frames)
    for (const Mark& mark : frame)
      if (const auto* path = std::get_if<Path>(&mark);
          path && path->places.size() == 2 && path->ink.width == 3)
        lengths.push_back(length(path->places[1] - path->places[0]));
  ASSERT_THAT(lengths, SizeIs(6));
  for (std::size_t i = 0; i < 6; i += 2) {
    EXPECT_NEAR(lengths[i], lengths[0], 1e-9);
    EXPECT_NEAR(lengths[i], 2 * lengths[i + 1], 1e-9);
  }
}

TEST(Movie, TextsOfACaseAreText) {
  Film film = small_film();
  film.heading = "</style><script>alert(1)</script>";
  film.diagram.x_name = film.diagram.points[1].label = "<b>\" &";
  film.frames[1].panel.title = "</g><script>";
  film.frames[1].panel.notes = {"x < 1"};
  const std::string svg = svg_text(animate(film, {.title = "</title><script>"}));
  EXPECT_THAT(svg, Not(HasSubstr("<script>")));
  EXPECT_THAT(svg, Not(HasSubstr("<b>")));
  EXPECT_THAT(svg, HasSubstr("&lt;b&gt;&quot; &amp;"));
  EXPECT_THAT(svg, HasSubstr("x &lt; 1"));
}

TEST(Movie, AnUnknownValueInterruptsTheCurveAndHasNoDot) {
  Film film = small_film();
  film.diagram.points[1].y = std::numeric_limits<double>::quiet_NaN();
  const Movie movie = animate(film, {});
  EXPECT_THAT(svg_text(movie), Not(HasSubstr("nan")));
  EXPECT_EQ(movie.frames[1].size() + 1, movie.frames[0].size());
}

TEST(Movie, WordsOfTheDiagramCoverNeitherEachOtherNorLines) {
  EXPECT_THAT(unreadable_words(animate(small_film(), {.title = "title"}).still), SizeIs(0));
}

TEST(Movie, TheLegendExplainsStatesThatOnlyTheCurveHas) {
  Film film = small_film();
  for (Frame& frame : film.frames) frame.panel.unstable_dead = 0;
  for (DiagramPoint& point : film.diagram.points) point.unstable_dead = 0;
  EXPECT_THAT(svg_text(animate(film, {})), Not(HasSubstr(">unstable<")));
  film.diagram.points[2].unstable_dead = 1;
  EXPECT_THAT(svg_text(animate(film, {})), HasSubstr(">unstable<"));
}

/// The straight curve from 0 to 4, with this many unstable modes on the way there and on the way back.
Film there_and_back(int there, int back) {
  Film film = small_film();
  film.diagram.points.clear();
  for (int i = 0; i <= 16; ++i) {
    const int modes = i <= 8 ? there : back;
    const double x = 0.5 * (i <= 8 ? i : 16 - i);
    film.diagram.points.push_back(
        {.x = x, .y = 0.1 * x, .unstable_dead = modes, .unstable_driven = modes});
  }
  return film;
}

/// Length of all lines of a colour and a width [px].
double length_of(const Picture& picture, const std::string& colour, double width) {
  double sum = 0;
  for (const Mark& mark : picture.marks)
    if (const auto* path = std::get_if<Path>(&mark);
        path && path->ink.stroke == colour && path->ink.width == width &&
        path->places.back().y < 430)  // above the legend
      for (std::size_t i = 1; i < path->places.size(); ++i)
        sum += length(path->places[i] - path->places[i - 1]);
  return sum;
}

TEST(Movie, DashesOfACurveThatRunsBackOverItselfAreDrawnOnce) {
  const Film film = there_and_back(1, 1);
  const Picture still = animate(film, {}).still;
  const double way = length(place_in_movie(film, film.diagram.points[8]) -
                            place_in_movie(film, film.diagram.points[0]));
  constexpr double piece = 3;  // lines are compared in pieces of this length
  EXPECT_NEAR(length_of(still, unstable_colour, 2), way, piece);
  EXPECT_THAT(svg_text(still), Not(HasSubstr("with a less stable one on it")));
}

TEST(Movie, AnUnstableWayBackOverAStableOneIsABandBeneathIt) {
  const Film film = there_and_back(0, 1);
  const Picture still = animate(film, {}).still;
  const double stable = length_of(still, stable_colour, 2);
  EXPECT_GT(stable, 300);
  EXPECT_LT(length_of(still, unstable_colour, 2), 60) << "the turn, as the worse side counts";
  EXPECT_NEAR(length_of(still, mixed_colour, mixed_width), stable, 60);
  EXPECT_THAT(svg_text(still), HasSubstr("with a less stable one on it"));
}

TEST(Movie, WhereStabilityIsNotKnownTheCurveHasDashesAndDots) {
  Film film = small_film();  // no point of it has counts
  const Picture still = animate(film, {}).still;
  const bool has_dots = std::any_of(still.marks.begin(), still.marks.end(), [](const Mark& mark) {
    const auto* path = std::get_if<Path>(&mark);
    return path && path->ink.stroke == ink_colour && path->ink.dashes.size() == 4;
  });
  EXPECT_TRUE(has_dots);
}

TEST(Movie, TheSameFilmGivesTheSameBytes) {
  EXPECT_EQ(svg_text(animate(small_film(), {})), svg_text(animate(small_film(), {})));
}

}  // namespace
}  // namespace springfold::drawing
