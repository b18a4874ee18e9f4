#include "io/law_formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/formula.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Value with the numbers of the case filled in, as a case reader does.
double value_at(const std::string& text, double u) {
  LawFormula law = read_law_formula(text, "u");
  EXPECT_THAT(law.problem, IsEmpty()) << text;
  FormulaBook book{{"k", "x"}};
  for (const auto& [step, part] : law.numbers) {
    const auto added = book.add(part);
    EXPECT_TRUE(added.id) << text << ": " << added.problem;
    law.formula.steps[step].number = added.id ? book.value(*added.id, {3, 5}) : std::nan("");
  }
  return model::evaluate(law.formula, u).value;
}

TEST(LawFormula, MeansWhatItMeansInOtherFormulas) {
  const double u = 0.3;
  FormulaBook book{{"k", "x", "u"}};
  for (const std::string text : {"u",
                                 "k*u + x*u^3",
                                 "-u^2",
                                 "2^-u",
                                 "u^2^2",
                                 "(u^2)^2",
                                 "-2^2*u",
                                 "k - u - x",
                                 "k/u/x",
                                 "k - (u - x)",
                                 "sin(u)*cos(2*u) + tan(u)",
                                 "asin(u) + acos(u) + atan(u)",
                                 "sinh(u) - cosh(u)/tanh(u)",
                                 "asinh(u) + acosh(1 + u) + atanh(u)",
                                 "exp(-k*u)*ln(1 + u)",
                                 "log(x + u) + log2(1 + u) - log10(2 + u)",
                                 "sqrt(1 + u)",
                                 "atan2(u, k)",
                                 "sum(u, k, x)",
                                 "avg(u, 2*u, x)",
                                 "max(k, x)*u",
                                 "(k > x ? 1 : 2)*u",
                                 "1e-3*u + .5E+1 * u",
                                 "+u",

                                 "abs(-k)*(u)",
                                 "k",
                                 "k*pi*deg + u*pi",
                                 "u*-k",
                                 "k*x",
                                 "(((u)))"}) {
    const auto id = book.add(text).id;
    ASSERT_TRUE(id) << text;
    const double expected = book.value(*id, {3, 5, u});
    EXPECT_NEAR(value_at(text, u), expected, 1e-14 * (1 + std::abs(expected))) << text;
  }
}

TEST(LawFormula, LeavesPartsWithoutTheDeformationAsText) {
  const LawFormula law = read_law_formula("(k + x)*u^(x - 1) + max(k, x) / 2", "u");
  std::vector<std::string> parts;
  for (const auto& number : law.numbers) parts.push_back(number.second);
  EXPECT_THAT(parts, testing::UnorderedElementsAre("(k + x)", "(x - 1)", "max(k, x) / 2"));
}

TEST(LawFormula, RefusesWhatIsNotSmooth) {
  for (const std::string text : {"abs(u)", "sign(u)*u", "min(u, 1)", "max(0, u)", "rint(u)",
                                 "u > 0 ? u : 0", "(u >= k)*u", "u*(k == u)", "u && k", "k || u"})
    EXPECT_THAT(read_law_formula(text, "u").problem, HasSubstr("need a smooth law")) << text;
}

TEST(LawFormula, SaysWhereTheTextIsNoFormula) {
  const auto problem = [](const std::string& text) { return read_law_formula(text, "u").problem; };
  EXPECT_THAT(problem(""), HasSubstr("ends too early"));
  EXPECT_THAT(problem("k*"), HasSubstr("ends too early"));
  EXPECT_THAT(problem("(k*u"), HasSubstr("closing parenthesis"));
  EXPECT_THAT(problem("k u"), HasSubstr("unexpected \"u\"; a product needs *"));
  EXPECT_THAT(problem("2u"), HasSubstr("unexpected \"u\"; a product needs *"));
  EXPECT_THAT(problem("k*u)"), HasSubstr("unexpected \")\""));
  EXPECT_THAT(problem("k*$u"), HasSubstr("unexpected \"$\""));
  EXPECT_THAT(problem("k*u**3"), HasSubstr("a power is written ^"));
  EXPECT_THAT(problem("pow(u, 3)"), HasSubstr("a power is written ^"));
  EXPECT_THAT(problem("f(u)"), HasSubstr("no function \"f\""));
  EXPECT_THAT(problem("u(u)"), HasSubstr("\"u\" is no function"));
  EXPECT_THAT(problem("sin(u, 2)"), HasSubstr("too many arguments for \"sin\""));
  EXPECT_THAT(problem("atan2(u)"), HasSubstr("too few arguments for \"atan2\""));
  EXPECT_THAT(problem(std::string(500, '(') + "u" + std::string(499, ')')),
              HasSubstr("parentheses deep"));
  EXPECT_THAT(problem(std::string(1200, '1')), HasSubstr("longer than"));
  EXPECT_THAT(problem(std::string(900, '-') + "u"), HasSubstr("too many signs"));
}

}  // namespace
}  // namespace springfold::io
