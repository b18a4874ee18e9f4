// Sensitivities to parameters whose value is 0, as imperfections have: nothing of the case says how large they are.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A flat arch of four bars, EA = 100, on springs of its angles that are softer by four orders of magnitude; g is one
/// more load where lambda acts, and along it.
std::string arch(double size) {
  const std::string s = std::to_string(size);
  return "[parameters]\ng = 0\n"
         "[[node]]\nname = \"l\"\nat = [-1, 0]\nfixed = true\n"
         "[[node]]\nname = \"r\"\nat = [1, 0]\nfixed = true\n"
         "[[node]]\nname = \"a\"\nat = [-0.5, 0.225]\n"
         "[[node]]\nname = \"b\"\nat = [0, 0.3]\n"
         "[[node]]\nname = \"c\"\nat = [0.5, 0.225]\n"
         "[[bar]]\nfrom = \"l\"\nto = \"a\"\nEA = 100\n[[bar]]\nfrom = \"a\"\nto = \"b\"\nEA = "
         "100\n"
         "[[bar]]\nfrom = \"b\"\nto = \"c\"\nEA = 100\n[[bar]]\nfrom = \"c\"\nto = \"r\"\nEA = "
         "100\n"
         "[[spring]]\nname = \"s\"\nshape = \"angle\"\nof = [\"a\", \"b\", \"c\"]\n"
         "law = { law = \"linear\", stiffness = " +
         s +
         ", free = \"pi\" }\n"
         "[[spring]]\nname = \"t\"\nshape = \"angle\"\nof = [\"l\", \"a\", \"b\"]\nlaw = { law = "
         "\"linear\", stiffness = " +
         s +
         ", free = \"pi\" }\n"
         "[[spring]]\nname = \"u\"\nshape = \"angle\"\nof = [\"b\", \"c\", \"r\"]\nlaw = { law = "
         "\"linear\", stiffness = " +
         s +
         ", free = \"pi\" }\n"
         "[[study]]\nname = \"s\"\nkind = \"sensitivity\"\nbody = \"b\"\ncontrol = "
         "\"load\"\ndirection = [0, -1]\n"
         "until = { b.y = [-0.45, 0.39] }\n"
         "loads = [{ on = \"b\", force = [0, \"-g\"] }]\nsensitivity = { parameters = [\"g\"] }\n";
}

TEST(ParameterOfValueZero, MovesTheLoadByItselfWhereItActsLikeIt) {
  for (const double stiffness : {0.02, 0.5}) {
    const auto ran = run(arch(stiffness));
    int found = 0;
    const analysis::Branch& branch = ran.of("s").branches.at(0);
    for (const analysis::Event& event : branch.events) {
      const double rate = value(ran.of("s"), event.row, "d(lambda)/d(g)");
      if (std::isnan(rate)) continue;
      ++found;
      EXPECT_NEAR(rate, -1, 1e-9) << event.label;
    }
    EXPECT_GE(found, 2);
  }
}

}  // namespace
}  // namespace springfold::io
