#include "further_curves.hpp"

#include <algorithm>

namespace springfold::io {
namespace {

constexpr std::size_t most_curves = 16;  ///< one after the other, each runs those before it
const std::string curve_kind = "critical_curve";

/// What says which curve is traced, and from where.
const std::vector<std::string> taken_over{"control",   "body",      "direction", "load",
                                          "loads",     "start",     "set",       "vary",
                                          "actuators", "parameter", "prescribed"};
/// Of `vary`: what is looked up in the runs belongs to each study, and it may call them otherwise.
const std::vector<std::string> own_of_vary{"table", "curves"},
    free_in_vary{"table", "curves", "labels"};

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Do they say the same?
bool is_same(const Node& a, const Node& b) {
  const auto same_entry = [&b](const NodeEntry& entry) {
    const Node* other = b.find(entry.key);
    return other != nullptr && is_same(entry.value, *other);
  };
  return a.kind == b.kind && a.text == b.text &&
         (a.kind == Node::Kind::text || a.number == b.number) && a.items.size() == b.items.size() &&
         a.entries.size() == b.entries.size() &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), is_same) &&
         std::all_of(a.entries.begin(), a.entries.end(), same_entry);
}

Node without(const std::vector<std::string>& parts, const std::string& key, Node node) {
  if (key == "vary")
    std::erase_if(node.entries, [&](const NodeEntry& entry) { return is_among(parts, entry.key); });
  return node;
}

std::string text_at(const Node& table, const std::string& key) {
  const Node* node = table.kind == Node::Kind::table ? table.find(key) : nullptr;
  return node != nullptr && node->kind == Node::Kind::text ? node->text : std::string{};
}

/// Its commands stay as they are.
bool keeps_commands(const Node& study) {
  const Node* table = study.find(curve_kind);
  const Node* tied =
      table != nullptr && table->kind == Node::Kind::table ? table->find("tied") : nullptr;
  return tied != nullptr && tied->kind == Node::Kind::boolean && tied->number == 0;
}

class Curves {
 public:
  Curves(std::vector<Item> studies, std::deque<Node>& copies, Problems& problems)
      : studies_{std::move(studies)}, copies_{copies}, problems_{problems} {
    found_.resize(studies_.size(), Found::nothing);
  }

  std::vector<Item> all() {
    for (std::size_t i = 0; i < studies_.size(); ++i) complete(i, 0);
    return std::move(studies_);
  }

 private:
  enum class Found { nothing, all, mistake };

  std::vector<std::string> names_without(std::size_t own) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < studies_.size(); ++i)
      if (i != own && text_at(*studies_[i].node, "kind") == curve_kind)
        names.push_back(text_at(*studies_[i].node, "name"));
    return names;
  }

  /// @returns whether the study has all that it needs. @param depth  studies that wait for it
  bool complete(std::size_t i, std::size_t depth) {
    if (found_[i] != Found::nothing) return found_[i] == Found::all;
    const auto row = curve_row(*studies_[i].node);
    if (!row) return true;
    const Node& of = *studies_[i].node->find(curve_kind)->find("of");
    const std::string key = studies_[i].key + "." + curve_kind + ".of";
    const auto refuse = [&](const std::string& what) {
      if (found_[i] == Found::nothing) problems_.add(of.place, key, what);
      found_[i] = Found::mistake;
      return false;
    };
    const auto earlier = std::find_if(studies_.begin(), studies_.end(), [&](const Item& item) {
      return text_at(*item.node, "name") == row->study;
    });
    const auto e = static_cast<std::size_t>(earlier - studies_.begin());
    if (earlier == studies_.end() || e == i)
      return refuse("got \"" + of.text + (e == i ? "\", the study itself" : "\"") +
                    ", need \"STUDY/ROW\" with the name of another study" +
                    suggestion(row->study, names_without(i)));
    if (const std::string kind = text_at(*earlier->node, "kind"); kind != curve_kind)
      return refuse("study \"" + row->study + "\" is of kind \"" +
                    (kind.empty() ? "force_deflection" : kind) +
                    "\", need one of kind \"critical_curve\"");
    if (depth >= most_curves)
      return refuse("studies begin at each other's curves in a circle, or more than " +
                    std::to_string(most_curves) + " one after the other");
    if (!complete(e, depth + 1)) {  // whose mistake is told
      found_[i] = Found::mistake;
      return false;
    }
    take_over(i, *studies_[e].node, row->study);
    found_[i] = Found::all;
    return true;
  }

  void take_over(std::size_t i, const Node& earlier, const std::string& name) {
    copies_.push_back(*studies_[i].node);
    Node& study = copies_.back();
    studies_[i].node = &study;
    const std::string where = "study \"" + name + "\", at whose curve it begins, ";
    for (const std::string& key : taken_over) {
      const Node* theirs = earlier.find(key);
      const Node* own = study.find(key);
      if (theirs != nullptr && own == nullptr) {
        study.entries.push_back({key, theirs->place, without(own_of_vary, key, *theirs)});
        continue;
      }
      const bool agrees =
          own == nullptr || (theirs != nullptr && is_same(without(free_in_vary, key, *own),
                                                          without(free_in_vary, key, *theirs)));
      if (!agrees)
        problems_.add(own->place, studies_[i].key + "." + key,
                      where + (theirs != nullptr ? "has another one" : "has none") +
                          ", need the same as there, or leave it out");
    }
    if (!keeps_commands(earlier)) return;
    Node& table = *study.find(curve_kind);
    if (const Node* tied = table.find("tied"); tied == nullptr)
      table.entries.push_back({"tied", table.place, plain_node(Node::Kind::boolean, table.place)});
    else if (!keeps_commands(study))
      problems_.add(tied->place, studies_[i].key + "." + curve_kind + ".tied",
                    where + "keeps its commands: those of the start would be others, need false");
  }

  std::vector<Item> studies_;
  std::deque<Node>& copies_;
  Problems& problems_;
  std::vector<Found> found_{};
};

}  // namespace

std::optional<CurveRow> curve_row(const std::string& of) {
  const std::size_t slash = of.rfind('/');
  if (slash == std::string::npos) return std::nullopt;
  return CurveRow{of.substr(0, slash), of.substr(slash + 1)};
}

std::optional<CurveRow> curve_row(const Node& study) {
  if (text_at(study, "kind") != curve_kind) return std::nullopt;
  const Node* table = study.find(curve_kind);
  return table == nullptr ? std::nullopt : curve_row(text_at(*table, "of"));
}

std::vector<Item> with_earlier_curves(const std::vector<Item>& studies, std::deque<Node>& copies,
                                      Problems& problems) {
  return Curves{studies, copies, problems}.all();
}

}  // namespace springfold::io
