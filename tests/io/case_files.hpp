// Case files written for a test, and what load_case says about them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// A folder of its own for every test, removed at its end.
class CaseFiles : public testing::Test {
 protected:
  CaseFiles() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path{testing::TempDir()} /
              (std::string{"springfold_"} + info->test_suite_name() + "_" + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~CaseFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream{file, std::ios::binary} << text;
    return file;
  }

  using Overrides = std::map<std::string, std::string>;

  Case load(const std::string& text, const Overrides& overrides = {}) const {
    return load_case(write("case.toml", text), overrides);
  }

  /// All messages, with the folder left out; empty if the case is good.
  std::vector<std::string> messages(const std::string& text,
                                    const Overrides& overrides = {}) const {
    const std::filesystem::path file = write("case.toml", text);
    return messages_of(file, overrides);
  }

  std::vector<std::string> messages_of(const std::filesystem::path& file,
                                       const Overrides& overrides = {}) const {
    std::vector<std::string> messages;
    try {
      load_case(file, overrides);
    } catch (const CaseError& error) {
      const std::string prefix = folder_.string() + "/";
      for (std::string message : error.messages()) {
        for (std::size_t at; (at = message.find(prefix)) != std::string::npos;)
          message.erase(at, prefix.size());
        messages.push_back(message);
      }
    }
    return messages;
  }

  std::filesystem::path folder_;
};

/// Replaces the first `from` by `to`; a test with a `from` that does not occur is wrong.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "no such text: " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A good case with one of everything; line numbers are used by the tests of messages.
inline std::string orthoglide_text() {
  return R"toml(title = "test"
[units]
length = "mm"
[parameters]
L = 1
K = 1
Kv = { value = "0.01*K*L^2", unit = "N*mm/rad", description = "knee" }
p = "0.454*L"
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg_x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = "L", stiffness = "K" },
  { joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } },
  { rigid = ["-L", 0] },
]
[[chain]]
name = "leg_y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = "L", stiffness = "K" },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } },
  { rigid = [0, "-L"] },
]
[[study]]
name = "Q2"
kind = "force_deflection"
control = "mixed"
direction = [1, 1]
load = [0, 0]
start = { pose = ["p", "p"], solve = "actuators", solver = "newton", attempts = 3, seed = 7 }
until = { "leg_x.knee" = ["-80*deg", "80*deg"], lambda = [-inf, inf] }
mark = { deflection = [0.1, 0.2] }
vary = { parameter = "Kv", values = [0, "0.1*K*L^2"] }
trace = { initial_step = 0.02, minimum_step = 1e-7, maximum_step = 0.04, maximum_points = 99 }
[[plot]]
name = "figure"
title = "a figure"
x = "deflection"
y = "force"
x_label = "d"
y_label = "f"
x_factor = "1/L"
y_factor = "1/(K*L)"
curves = [{ study = "Q2", runs = [1, 2], labels = ["one", "two"] }]
)toml";
}

}  // namespace springfold::io
