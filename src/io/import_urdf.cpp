#include "springfold/io/import_urdf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "robot.hpp"
#include "source_files.hpp"
#include "springfold/io/case_file.hpp"
#include "text.hpp"
#include "toml_text.hpp"

namespace springfold::io {
namespace {

using RobotFrame = Eigen::Isometry3d;

RobotFrame frame_before(const RobotLink& link) {
  RobotFrame frame = RobotFrame::Identity();
  frame.translation() = link.shift;
  const double angle = link.turn.norm();
  if (angle > 0) frame.linear() = Eigen::AngleAxisd(angle, link.turn / angle).toRotationMatrix();
  return frame;
}

std::string list_of(const model::Vec3<double>& v) {
  return "[" + shortest(v[0]) + ", " + shortest(v[1]) + ", " + shortest(v[2]) + "]";
}

/// ", inertia = [[...], [...], [...]]" behind something; nothing where there is none.
std::string inertia_behind(const std::string& before, const model::Mat3<double>& I,
                           const std::string& after) {
  if (I.isZero(0)) return "";
  return before + "inertia = [" + list_of(I.row(0)) + ", " + list_of(I.row(1)) + ", " +
         list_of(I.row(2)) + "]" + after;
}

/// Names of the case: letters, digits, '_' and '-' only, no two alike.
class RobotNames {
 public:
  explicit RobotNames(std::set<std::string> taken) : taken_{std::move(taken)} {}

  /// @param otherwise  where nothing is wanted
  std::string make(const std::string& wanted, const std::string& otherwise) {
    std::string name;
    for (const char c : wanted)
      name += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '-'
                  ? c
                  : '_';
    if (name.empty()) name = otherwise;
    std::string unique = name;
    for (int i = 2; !taken_.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    if (unique != wanted) ++changed;
    return unique;
  }

  int changed = 0;

 private:
  std::set<std::string> taken_;
};

class RobotCase {
 public:
  explicit RobotCase(const Robot& robot)
      : robot_{robot},
        children_(robot.links.size()),
        places_(robot.links.size(), RobotFrame::Identity()) {
    for (std::size_t i = 1; i < robot.links.size(); ++i) {
      children_[robot.links[i].parent].push_back(i);
      places_[i] = places_[robot.links[i].parent] * frame_before(robot.links[i]);
    }
    for (std::size_t i = 1; i < robot.links.size(); ++i)
      if (is_station(i)) stations_[i] = names_.make(robot.links[i].name, "link");
  }

  std::string write(const std::string& title) {
    text_ =
        "# Made by `springfold import`: bodies at the ends of a robot's chains, elastic drives.\n";
    text_ += "title = " + toml_text(title) + "\n\n";
    write_parameters();
    for (const auto& [link, name] : stations_) write_body(link, name);
    for (const auto& [link, name] : stations_) write_chain(link, name);
    text_ += "[[study]]\nname = \"rest\"\nkind = \"equilibrium\"\nbody = \"" +
             stations_.rbegin()->second + "\"\n";
    return std::move(text_);
  }

  std::vector<std::string> report() const {
    std::vector<std::string> lines{
        counted(robot_.links.size(), "link") + ": the base \"" + robot_.links[0].name + "\", " +
        counted(stations_.size(), "body", "bodies") + ", " + counted(joints_, "elastic drive")};
    lines.emplace_back(
        "stiffnesses are placeholders: put in your own, and commands, loads and studies");
    if (has_mass_) lines.emplace_back("masses have no weight until the case has a gravity");
    if (robot_.links[0].mass > 0) lines.emplace_back("left out: the mass of the base");
    if (changed_ + names_.changed > 0)
      lines.push_back(
          counted(static_cast<std::size_t>(changed_ + names_.changed), "name is", "names are") +
          " written otherwise: with other characters, or with a number to tell them apart");
    lines.insert(lines.end(), robot_.left_out.begin(), robot_.left_out.end());
    return lines;
  }

 private:
  static std::string counted(std::size_t count, const std::string& one, std::string more = "") {
    if (more.empty()) more = one + "s";
    return std::to_string(count) + " " + (count == 1 ? one : more);
  }

  /// Where chains end or part.
  bool is_station(std::size_t link) const { return children_[link].size() != 1; }

  void write_parameters() {
    const auto has = [this](RobotJoint kind) {
      return std::any_of(robot_.links.begin(), robot_.links.end(),
                         [kind](const RobotLink& link) { return link.joint == kind; });
    };
    text_ += "[parameters]\n";
    if (has(RobotJoint::revolute))
      text_ +=
          "k_turn = { value = 1000, unit = \"N*m/rad\", description = \"stiffness of drives that "
          "turn\" }\n";
    if (has(RobotJoint::prismatic))
      text_ +=
          "k_slide = { value = 1e5, unit = \"N/m\", description = \"stiffness of drives that "
          "slide\" }\n";
    text_ += "\n";
  }

  void write_body(std::size_t i, const std::string& name) {
    const RobotLink& link = robot_.links[i];
    const Eigen::AngleAxisd turn(places_[i].linear());
    const model::Vec3<double> vector = turn.angle() * turn.axis();
    text_ += "[[body]]\nname = \"" + name + "\"\ntask_space = \"spatial\"\npose = [";
    for (const double x : places_[i].translation()) text_ += shortest(x) + ", ";
    text_ += shortest(vector[0]) + ", " + shortest(vector[1]) + ", " + shortest(vector[2]) + "]\n";
    if (link.mass > 0) {
      text_ += "mass = " + shortest(link.mass) + "\ncom = " + list_of(link.com) + "\n" +
               inertia_behind("", link.inertia, "\n");
      has_mass_ = true;
    }
    text_ += "\n";
  }

  void write_chain(std::size_t end, const std::string& name) {
    std::vector<std::size_t> way{end};
    while (robot_.links[way.back()].parent != 0 && !is_station(robot_.links[way.back()].parent))
      way.push_back(robot_.links[way.back()].parent);
    std::reverse(way.begin(), way.end());
    const std::size_t first = robot_.links[way.front()].parent;
    text_ += "[[chain]]\nname = \"" + names_.make("to_" + name, "chain") + "\"\n";
    if (first != 0) text_ += "from = \"" + stations_.at(first) + "\"\n";
    text_ += "to = \"" + name + "\"\nelements = [\n";
    RobotNames own{{}};
    for (const std::size_t i : way) write_link(robot_.links[i], i == end, own);
    text_ += "]\n\n";
    changed_ += own.changed;
  }

  void write_link(const RobotLink& link, bool is_end, RobotNames& own) {
    const double angle = link.turn.norm();
    if (angle > 0)
      text_ += "  { rigid = { at = " + list_of(link.shift) +
               ", rotate = { axis = " + list_of(link.turn / angle) +
               ", angle = " + shortest(angle) + " } } },\n";
    else if (link.shift.norm() > 0 || link.joint == RobotJoint::fixed)
      text_ += "  { rigid = " + list_of(link.shift) + " },\n";
    if (link.joint != RobotJoint::fixed) {
      const bool turns = link.joint == RobotJoint::revolute;
      text_ += std::string{"  { joint = \""} + (turns ? "revolute" : "prismatic") +
               "\", axis = " + list_of(link.axis) + ", name = \"" +
               own.make(link.joint_name, "joint") +
               "\", role = \"actuated\", value = 0, stiffness = \"" +
               (turns ? "k_turn" : "k_slide") + "\" },\n";
      ++joints_;
    }
    if (link.mass > 0 && !is_end) {  // of a body it is the body's own
      if (link.inertia.isZero(0))
        text_ += "  { point = \"" + own.make("com_" + link.name, "com") +
                 "\", at = " + list_of(link.com) + ", mass = " + shortest(link.mass) + " },\n";
      else
        text_ += "  { rigid = [0, 0, 0], mass = " + shortest(link.mass) +
                 ", com = " + list_of(link.com) + inertia_behind(", ", link.inertia, "") + " },\n";
      has_mass_ = true;
    }
  }

  const Robot& robot_;
  std::vector<std::vector<std::size_t>> children_{};
  std::vector<RobotFrame, Eigen::aligned_allocator<RobotFrame>>
      places_{};  ///< at commands 0, in the base's frame
  std::map<std::size_t, std::string>
      stations_{};  ///< names of the bodies by the numbers of their links
  RobotNames names_{{"base"}};
  std::size_t joints_ = 0;
  int changed_ = 0;
  bool has_mass_ = false;
  std::string text_{};
};

}  // namespace

ImportedCase import_urdf(const std::filesystem::path& file,
                         const std::function<bool()>& stop_requested) {
  Problems problems;
  const auto throw_problems = [&problems] {
    if (!problems.empty()) throw CaseError(problems.messages());
  };
  const auto bytes = SourceReader{problems, stop_requested}.read_text(file, {}, "");
  throw_problems();
  const Robot robot = read_urdf(*bytes, file.string(), problems);
  throw_problems();
  const bool moves = std::any_of(robot.links.begin(), robot.links.end(), [](const RobotLink& link) {
    return link.joint != RobotJoint::fixed;
  });
  if (!moves)
    problems.add({file.string(), 0, 0}, "", "no joint moves, need one that is not fixed at least");
  throw_problems();
  RobotCase made(robot);
  std::string text = made.write(robot.name.empty() ? file.stem().string() : robot.name);
  return {std::move(text), made.report()};
}

}  // namespace springfold::io
