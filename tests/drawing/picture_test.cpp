#include <gmock/gmock.h>

#include "drawing/glyphs.hpp"
#include "drawing/mechanisms.hpp"
#include "springfold/drawing/illustration.hpp"

namespace springfold::drawing {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(Picture, ALineMeetsABoxIfItEntersOrEndsInIt) {
  const Box box{0, 0, 10, 10};
  EXPECT_TRUE(crosses({-5, 5}, {15, 5}, box));
  EXPECT_TRUE(crosses({5, 5}, {6, 6}, box));
  EXPECT_TRUE(crosses({-5, 5}, {5, 5}, box));
  EXPECT_FALSE(crosses({-5, 5}, {-1, 5}, box));
  EXPECT_FALSE(crosses({-5, 5}, {5, 20}, box));  // passes the corner (0, 10) outside
}

TEST(Picture, WordsOnWordsAndOnLinesAreSeen) {
  Picture picture{.width = 200, .height = 200};
  picture.marks.emplace_back(Words{.at = {50, 50}, .text = "one"});
  EXPECT_THAT(unreadable_words(picture), IsEmpty());
  picture.marks.emplace_back(Words{.at = {52, 54}, .text = "two"});
  EXPECT_THAT(unreadable_words(picture), SizeIs(1));
  picture.marks.emplace_back(Path{{{0, 54}, {200, 54}}});
  EXPECT_THAT(unreadable_words(picture), SizeIs(2));  // "two" stands on it
  picture.marks.emplace_back(Words{.at = {190, 150}, .text = "outside"});
  EXPECT_THAT(unreadable_words(picture), SizeIs(3));
}

TEST(Svg, TextsOfACaseAreText) {
  Picture picture{.width = 10, .height = 10, .title = "</title><script>alert(1)</script>"};
  picture.marks.emplace_back(Words{.text = R"("; system("x") & 'y' <b>)"});
  picture.marks.emplace_back(Disc{.title = "\x01\xff\xed\xa0\x80 é"});
  const std::string svg = svg_text(picture);
  EXPECT_THAT(svg, Not(HasSubstr("<script>")));
  EXPECT_THAT(svg, HasSubstr("&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_THAT(svg, HasSubstr("&quot;; system(&quot;x&quot;) &amp; &#39;y&#39; &lt;b&gt;"));
  EXPECT_THAT(svg, Not(HasSubstr("\x01")));
  EXPECT_THAT(svg, Not(HasSubstr("\xff")));
  EXPECT_THAT(svg, HasSubstr(" é</title>"));
}

TEST(Svg, NumbersHaveNoNegativeZeroAndTwoDecimals) {
  Picture picture{.width = 10, .height = 10};
  picture.marks.emplace_back(Path{{{-0.001, 1.0 / 3}, {2, 1e3}}, false, {"#000000"}});
  EXPECT_THAT(svg_text(picture), HasSubstr("points=\"0,0.33 2,1000\""));
}

TEST(Glyphs, ACoilStretchesBetweenItsEnds) {
  for (const Place end : {Place{30, 0}, Place{60, 80}}) {
    const std::vector<Place> places = coil({0, 0}, end, 5);
    EXPECT_EQ(places.front().x, 0);
    EXPECT_EQ(places.front().y, 0);
    EXPECT_EQ(places.back().x, end.x);
    EXPECT_EQ(places.back().y, end.y);
    for (const Place place : places)  // no farther from its axis than half its width
      EXPECT_LE(std::abs(place.x * end.y - place.y * end.x) / length(end), 5 + 1e-12);
  }
}

TEST(Glyphs, TheHullOfASquareAndItsMiddleIsTheSquare) {
  const auto corners = hull({{0, 0}, {2, 2}, {1, 1}, {2, 0}, {0, 2}});
  EXPECT_THAT(corners, SizeIs(4));
  for (const Place p : corners) EXPECT_FALSE(p.x == 1 && p.y == 1);
}

Panel panel(double shoulder, double elbow, const std::string& title) {
  const statics::System system = statics::prepare(two_links());
  Posture posture = posture_of(system, shoulder, elbow, 1, 1);
  posture.wrenches.push_back({.body = 1, .force = {1, 0, 0}});
  return {.scene = scene_of(system, posture), .title = title};
}

TEST(Illustration, WordsCoverNeitherEachOtherNorLines) {
  for (const double shoulder : {-2.0, -1.0, 0.0, 1.0, 2.0, 3.0})
    for (const double elbow : {-2.5, -0.7, 0.0, 0.7, 2.5}) {
      const Picture picture = illustrate({panel(shoulder, elbow, "posture")}, {});
      EXPECT_THAT(unreadable_words(picture), IsEmpty()) << shoulder << " " << elbow;
    }
}

TEST(Illustration, SeveralPanelsHaveOneScale) {
  const Picture picture =
      illustrate({panel(0, 0, "first"), panel(1, 1, "second"), panel(2, 0, "third")}, {});
  EXPECT_THAT(unreadable_words(picture), IsEmpty());
  // The first link is 2 long in all of them.
  std::vector<double> lengths;
  for (const Mark& mark : picture.marks)
    if (const auto* path = std::get_if<Path>(&mark); path && path->title.starts_with("chain arm") &&
                                                     path->places.size() == 2 &&
                                                     path->ink.dashes.empty())
      lengths.push_back(length(path->places[1] - path->places[0]));
  ASSERT_THAT(lengths, SizeIs(6));
  for (std::size_t i = 0; i < 6; i += 2) {
    EXPECT_NEAR(lengths[i], lengths[0], 1e-9);
    EXPECT_NEAR(lengths[i], 2 * lengths[i + 1], 1e-9);
  }
}

TEST(Illustration, StabilityIsNamedByWhatHoldsTheMechanism) {
  Panel stable = panel(0, 0, ""), held = stable, unstable = stable;
  stable.unstable_dead = 0;
  held.unstable_dead = 1;
  held.unstable_driven = 0;
  unstable.unstable_dead = 1;
  unstable.unstable_driven = 1;
  const std::string svg = svg_text(illustrate({stable, held, unstable}, {}));
  EXPECT_THAT(svg, HasSubstr("stable under dead load"));
  EXPECT_THAT(svg, HasSubstr("held as driven, unstable under dead load"));
  EXPECT_THAT(svg, HasSubstr(">unstable<"));
  EXPECT_THAT(svg_text(illustrate({panel(0, 0, "")}, {})), HasSubstr("stability not known"));
}

TEST(Illustration, TheSameSceneGivesTheSameBytes) {
  EXPECT_EQ(svg_text(illustrate({panel(1, 2, "a")}, {})),
            svg_text(illustrate({panel(1, 2, "a")}, {})));
}

TEST(View, FromAboveIsThePlan) {
  const View view = view_from(-1.5707963267948966, 1.5707963267948966);
  EXPECT_NEAR(view.right.x(), 1, 1e-15);
  EXPECT_NEAR(view.up.y(), 1, 1e-15);
}

/// A bar from the base to a node, and no chain but perhaps the guide of the node.
Panel bar(int unstable, bool is_guided = false) {
  model::Mechanism mechanism;
  if (is_guided)
    mechanism.chains.push_back({.name = "node.guide",
                                .from_attachment = {.p = model::Vec3<double>{0, 1, 0}},
                                .elements = {model::Joint{.kind = model::JointKind::prismatic,
                                                          .axis = model::Vec3<double>::UnitX(),
                                                          .initial = 1}}});
  mechanism.bodies.push_back(
      {.name = "node", .task_space = model::TaskSpace::xy, .pose = Vector::Ones(2)});
  mechanism.line_springs.push_back({.name = "rod", .to = {.body = 1}, .stiffness = 1, .free = 1});
  const statics::System system = statics::prepare(mechanism);
  return {.scene = scene_of(system, guess_posture(system)), .unstable_dead = unstable};
}

TEST(Bars, HaveTheColourOfStabilityWhereThereIsNoLink) {
  for (const auto& [unstable, colour] : {std::pair{0, "#0072b2"}, {1, "#d55e00"}}) {
    const std::string svg = svg_text(illustrate({bar(unstable)}, {}));
    const auto title = svg.find("<title>spring rod");
    ASSERT_NE(title, std::string::npos);
    const auto begin = svg.rfind("<polyline", title);
    EXPECT_THAT(svg.substr(begin, title - begin), HasSubstr(std::string{"stroke=\""} + colour));
    EXPECT_THAT(svg, Not(HasSubstr(">spring<"))) << "nothing is drawn in the colour of springs";
  }
}

TEST(Bars, HaveTheColourOfStabilityBetweenNodesOnRollersToo) {
  const std::string svg = svg_text(illustrate({bar(0, true)}, {}));
  const auto title = svg.find("<title>spring rod");
  const auto begin = svg.rfind("<polyline", title);
  EXPECT_THAT(svg.substr(begin, title - begin), HasSubstr("stroke=\"#0072b2"));
}

TEST(Bars, HaveTheColourOfSpringsWhereColoursSayNothing) {
  const std::string svg = svg_text(illustrate({bar(0)}, {.colouring = Colouring::none}));
  EXPECT_THAT(svg, HasSubstr(">spring<"));
  EXPECT_THAT(svg, HasSubstr("#007a5e"));
}

}  // namespace
}  // namespace springfold::drawing
