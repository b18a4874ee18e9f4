#include "io/formula.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <locale>
#include <numbers>
#include <thread>

#include "case_files.hpp"

namespace springfold::io {
namespace {

double value_of(const std::string& text, double L = 2, double K = 3) {
  FormulaBook book{{"L", "K"}};
  const auto added = book.add(text);
  EXPECT_TRUE(added.id) << text << ": " << added.problem;
  return added.id ? book.value(*added.id, {L, K}) : std::nan("");
}

std::string problem_of(const std::string& text) {
  FormulaBook book{{"L", "K", "Kv"}};
  const auto added = book.add(text);
  EXPECT_FALSE(added.id) << text;
  return added.problem;
}

TEST(Formula, KnowsPiAndDegreesToFullPrecision) {
  EXPECT_EQ(value_of("pi"), std::numbers::pi);
  EXPECT_EQ(value_of("180*deg"), 180 * (std::numbers::pi / 180));
  EXPECT_EQ(value_of("sin(pi/6)"), std::sin(std::numbers::pi / 6));
}

TEST(Formula, FollowsTheUsualRules) {
  EXPECT_EQ(value_of("1 + 2*3"), 7);
  EXPECT_EQ(value_of("-L^2"), -4);
  EXPECT_EQ(value_of("2^3^2"), 512);
  EXPECT_EQ(value_of("2^-1"), 0.5);
  EXPECT_EQ(value_of(" ( L + K ) / 2 "), 2.5);
  EXPECT_EQ(value_of("1.5e-3*1E3 + .5"), 2);
  EXPECT_EQ(value_of("L > 1 ? 10 : 20"), 10);
  EXPECT_EQ(value_of("L == 2 && K >= 3"), 1);
  EXPECT_EQ(value_of("min(L, K, 1) + max(L, K)"), 4);
}

TEST(Formula, HasTheFunctionsThatTheDocumentationNames) {
  EXPECT_EQ(value_of("atan2(1, -1)"), std::atan2(1.0, -1.0));
  EXPECT_EQ(value_of("ln(L)"), std::log(2.0));
  EXPECT_EQ(value_of("log(L)"), std::log(2.0));
  EXPECT_EQ(value_of("log10(100) + log2(8)"), 5);
  EXPECT_EQ(value_of("sqrt(16) + abs(-1) + sign(-3) + rint(2.4)"), 6);
  for (const char* name :
       {"sin",   "cos",   "tan",   "asin", "acos", "atan", "sinh", "cosh",  "tanh",
        "asinh", "acosh", "atanh", "exp",  "ln",   "log",  "log2", "log10", "sqrt",
        "abs",   "sign",  "rint",  "min",  "max",  "sum",  "avg"})
    EXPECT_FALSE(std::isinf(value_of(std::string{name} + "(0.5)"))) << name;
}

TEST(Formula, GivesInfinityOrNaNWhereThereIsNoNumber) {
  EXPECT_TRUE(std::isinf(value_of("1/0")));
  EXPECT_TRUE(std::isnan(value_of("sqrt(-L)")));
}

TEST(Formula, NamesWhatItDoesNotKnow) {
  EXPECT_EQ(problem_of("2*Kw"), "no parameter \"Kw\", did you mean \"Kv\"?");
  EXPECT_EQ(problem_of("zeta"), "no parameter \"zeta\"; known here: L, K, Kv");
  EXPECT_EQ(problem_of("sqr(L)"), "no function \"sqr\", did you mean \"sqrt\"?");
  EXPECT_EQ(problem_of("sin"), "the function \"sin\" needs its argument in parentheses");
  EXPECT_EQ(problem_of("L(2)"), "\"L\" is no function; a product needs *");
  FormulaBook nothing{{}};
  EXPECT_EQ(nothing.add("L").problem, "no parameter \"L\"; the case has no [parameters]");
}

TEST(Formula, SaysWhatIsWrongWithItsForm) {
  EXPECT_EQ(problem_of(""), "it is empty");
  EXPECT_EQ(problem_of("  "), "it is empty");
  EXPECT_EQ(problem_of("2L"), "unexpected \"L\"; a product needs *");
  EXPECT_EQ(problem_of("2*(L"), "a closing parenthesis is missing");
  EXPECT_EQ(problem_of("2*L)"), "unexpected parenthesis \")\"");
  EXPECT_EQ(problem_of("2*"), "it ends too early");
  EXPECT_EQ(problem_of("-"), "it ends too early");
  EXPECT_EQ(problem_of("1,5"), "unexpected \",\"; need one value");
  EXPECT_EQ(problem_of("atan2(1)"), "too few arguments for \"atan2\"");
  EXPECT_EQ(problem_of("sin(1, 2)"), "too many arguments for \"sin\"");
  EXPECT_EQ(problem_of("L = 3"), "\"=\" has no meaning here");
  EXPECT_EQ(problem_of("L**2"), "a power is written ^, as in u^3");
  EXPECT_EQ(problem_of("pow(L, 2)"), "no function \"pow\"; a power is written ^, as in u^3");
  EXPECT_EQ(problem_of("3%"), "unexpected \"%\"");
  EXPECT_FALSE(problem_of("L \xc3\x97 2").empty());
  EXPECT_FALSE(problem_of("\"L\"").empty());
  EXPECT_FALSE(problem_of(std::string(100000, '(')).empty());
}

TEST(Formula, IsTheSameInEveryLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale{std::locale::classic(), new Comma});
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  const double value = value_of("0.5*1234.25 + 1e-1");
  const std::string problem = problem_of("0,5");
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
  EXPECT_EQ(value, 0.5 * 1234.25 + 1e-1);
  EXPECT_EQ(problem, "unexpected \",\"; need one value");
}

TEST(Formula, MayBeEvaluatedFromSeveralThreads) {
  FormulaBook book{{"L", "K"}};
  const FormulaId id = *book.add("L^2 + K").id;
  const auto sum = [&](double L) {
    double total = 0;
    for (int i = 0; i < 2000; ++i) total += book.value(id, {L, 1});
    return total;
  };
  double a = 0, b = 0;
  std::thread first{[&] { a = sum(2); }}, second{[&] { b = sum(3); }};
  first.join();
  second.join();
  EXPECT_EQ(a, 2000 * 5.0);
  EXPECT_EQ(b, 2000 * 10.0);
}

TEST(Formula, IsCompiledOnce) {
  FormulaBook book{{"L"}};
  EXPECT_EQ(book.add("2*L").id, book.add("2*L").id);
  EXPECT_NE(book.add("2*L").id, book.add("3*L").id);
  EXPECT_EQ(book.variables_of(*book.add("2*L").id), std::vector<std::size_t>{0});
  EXPECT_TRUE(book.variables_of(*book.add("2").id).empty());
}

}  // namespace
}  // namespace springfold::io
