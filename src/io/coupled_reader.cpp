// `coupled_springs` of a chain: preloaded joints whose torques depend on each other's coordinates.
#include <algorithm>

#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

using model::Definiteness;
using model::JointRole;

const std::string coupled_example =
    "coupled_springs = [{ joints = [\"a\", \"b\"], stiffness = [[2, 1], [1, 2]] }]";

std::string law_of(const SpringDraft& spring) {
  static const char* const names[] = {"linear", "one_sided", "piecewise_linear", "gap", "stops"};
  return names[spring.index()];
}

/// Why the joint cannot take part; empty if it can.
std::string joint_problem(const JointDraft& joint) {
  if (joint.role == JointRole::compliant)
    return "is a virtual joint, need preloaded ones; a link that gives way in coupled directions "
           "is "
           "{ elastic = ... }";
  if (joint.role != JointRole::preloaded)
    return "has no spring to couple, need role = \"preloaded\"";
  if (!joint.spring) return {};
  if (std::holds_alternative<LinearDraft>(*joint.spring))
    return "has a spring of its own; leave it out and add its stiffness to the diagonal";
  return "has a spring of law \"" + law_of(*joint.spring) +
         "\", which switches: where some joints of a coupled spring act and others do not its "
         "tangent "
         "is not symmetric and there is no energy; coupled springs are linear";
}

class CoupledReader {
 public:
  CoupledReader(const Item& item, const ChainDraft& chain, NumberTable& numbers, Reading& reading)
      : table_{*item.node, item.key, {"name", "joints", "stiffness", "free"}, reading},
        chain_{chain},
        numbers_{numbers},
        reading_{reading} {
    draft_.place = item.node->place;
    draft_.key = item.key;
  }

  CoupledDraft read() {
    draft_.name = table_.text("name").value_or("");
    const bool known = read_joints();
    const Node* matrix = table_.require(
        "stiffness", "a list of rows of numbers, one row and column for every joint");
    if (known && matrix)
      draft_.stiffness =
          read_symmetric_matrix({matrix, table_.key_of("stiffness")}, draft_.joints.size(),
                                Definiteness::semidefinite, numbers_, reading_);
    if (known) read_free();
    return std::move(draft_);
  }

 private:
  /// Are all of them usable?
  bool read_joints() {
    const std::string need = "a list of at least two joints of this chain";
    const Node* list = table_.require("joints", need);
    if (!list) return false;
    const std::vector<Item> items = table_.list("joints", need);
    if (list->kind == Node::Kind::array && items.size() < 2)
      reading_.problems.add(
          list->place, table_.key_of("joints"),
          "got " + described(*list) + ", need " + need + "; one alone has spring = { ... }");
    bool usable = items.size() >= 2;
    for (const Item& item : items) {
      const auto place = find(item);
      usable = usable && place;
      if (place) draft_.joints.push_back(*place);
    }
    return usable;
  }

  std::optional<std::size_t> find(const Item& item) {
    const auto report = [&](const std::string& what) {
      reading_.problems.add(item.node->place, item.key, what);
      return std::nullopt;
    };
    std::vector<std::string> known;
    for (std::size_t i = 0; i < chain_.elements.size(); ++i) {
      const auto* joint = std::get_if<JointDraft>(&chain_.elements[i].content);
      if (joint == nullptr) continue;
      known.push_back(joint->name);
      if (item.node->kind != Node::Kind::text || joint->name != item.node->text) continue;
      if (const std::string problem = joint_problem(*joint); !problem.empty())
        return report("\"" + joint->name + "\" " + problem);
      const auto has = [i](const CoupledDraft& other) {
        return std::find(other.joints.begin(), other.joints.end(), i) != other.joints.end();
      };
      if (has(draft_) || std::any_of(chain_.coupled.begin(), chain_.coupled.end(), has))
        return report("\"" + joint->name + "\" is named twice, need one matrix for all its joints");
      return i;
    }
    if (item.node->kind != Node::Kind::text)
      return report("got " + described(*item.node) + ", need the name of a joint");
    return report("no joint \"" + item.node->text + "\" in this chain" +
                  suggestion(item.node->text, known));
  }

  void read_free() {
    const std::string need =
        "a list of " + std::to_string(draft_.joints.size()) + " numbers, one per joint";
    const std::vector<Item> items = table_.list("free", need);
    const Node* node = table_.find("free");
    if (node && node->kind == Node::Kind::array && items.size() != draft_.joints.size())
      reading_.problems.add(node->place, table_.key_of("free"),
                            "got " + described(*node) + ", need " + need);
    for (std::size_t i = 0; i < draft_.joints.size(); ++i) {
      const auto& joint = std::get<JointDraft>(chain_.elements[draft_.joints[i]].content);
      const Rule rule{Range::finite, units_of(joint.kind, reading_.units).coordinate};
      draft_.free.push_back(i < items.size() ? read_number(items[i], rule, numbers_, reading_)
                                             : numbers_.add(0));
    }
  }

  TableReader table_;
  const ChainDraft& chain_;
  NumberTable& numbers_;
  Reading& reading_;
  CoupledDraft draft_{};
};

}  // namespace

std::set<std::string> coupled_joint_names(const Node& chain) {
  std::set<std::string> names;
  const Node* list = chain.find("coupled_springs");
  if (!list || list->kind != Node::Kind::array) return names;
  for (const Node& spring : list->items) {
    const Node* joints = spring.kind == Node::Kind::table ? spring.find("joints") : nullptr;
    if (!joints || joints->kind != Node::Kind::array) continue;
    for (const Node& joint : joints->items)
      if (joint.kind == Node::Kind::text) names.insert(joint.text);
  }
  return names;
}

void read_coupled_springs(const TableReader& table, NumberTable& numbers, ChainDraft& chain,
                          Reading& reading) {
  for (const Item& item : table.tables("coupled_springs", coupled_example))
    chain.coupled.push_back(CoupledReader{item, chain, numbers, reading}.read());
}

std::vector<NumberId> read_symmetric_matrix(const Item& item, std::size_t size,
                                            Definiteness definite, NumberTable& numbers,
                                            Reading& reading) {
  const std::string rows = std::to_string(size);
  const std::string need = "a list of " + rows + " rows of " + rows + " numbers";
  std::vector<NumberId> matrix(size * size, numbers.add(0));
  const std::vector<Item> items = list_items(item, need, reading);
  if (item.node->kind != Node::Kind::array) return matrix;
  if (items.size() != size) {
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) + ", need " + need);
    return matrix;
  }
  bool whole = true;
  for (std::size_t i = 0; i < size; ++i) {
    const std::string need_row = "a list of " + rows + " numbers";
    const std::vector<Item> row = list_items(items[i], need_row, reading);
    whole = whole && row.size() == size;
    if (items[i].node->kind == Node::Kind::array && row.size() != size)
      reading.problems.add(items[i].node->place, items[i].key,
                           "got " + described(*items[i].node) + ", need " + need_row);
    for (std::size_t j = 0; j < std::min(size, row.size()); ++j)
      matrix[i * size + j] = read_number(row[j], {}, numbers, reading);
  }
  if (!whole) return matrix;
  numbers.require(matrix, item.node->place, item.key,
                  [size, definite](const std::vector<double>& n) {
                    const auto m = static_cast<Index>(size);
                    Matrix values(m, m);
                    for (Index i = 0; i < m * m; ++i)
                      values(i / m, i % m) = n[static_cast<std::size_t>(i)];
                    return model::problem_in(values, definite);
                  });
  return matrix;
}

}  // namespace springfold::io
