#include "repetition.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bindings.hpp"
#include "case_hints.hpp"
#include "formula.hpp"
#include "index_range.hpp"
#include "pattern.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using Shared = std::shared_ptr<const Bindings>;

constexpr std::size_t most_copies = 10000;  ///< as many tables of one name a case may have
constexpr std::size_t most_levels = 8;      ///< templates and groups within each other
/// Keys and values of all copies together. One takes about 200 bytes.
constexpr std::size_t most_values = 500'000;
constexpr std::size_t text_of_a_value = 100;

/// Keys and values, long texts as several.
std::size_t size_of(const Node& node) {
  std::size_t size = 1 + node.text.size() / text_of_a_value;
  for (const Node& item : node.items) size += size_of(item);
  for (const NodeEntry& entry : node.entries) size += size_of(entry.value);
  return size;
}

void remove_key(Node& table, std::string_view key) {
  std::erase_if(table.entries, [key](const NodeEntry& entry) { return entry.key == key; });
}

class Expander {
 public:
  Expander(std::vector<Document>& documents, Problems& problems)
      : documents_{documents}, problems_{problems} {}

  /// @returns hints
  std::vector<std::string> run() {
    for (const Document& document : documents_) {
      collect_names(document.root);
      collect_templates(document.root);
    }
    for (const auto& [name, table] : templates_) check_defaults(name, *table);
    const auto expand = [this](const auto& wanted) {
      for (Document& document : documents_)
        for (const std::string& part : parts_of_mechanism())
          if (Node* list = wanted(part) ? document.root.find(part) : nullptr)
            expand_list(*list, part, {}, 0);
    };
    const auto has_frame = [](const std::string& part) { return part == "body" || part == "node"; };
    expand(has_frame);  // first: patterns of the others ask where they stand
    for (const Document& document : documents_) drawn_.add(document.root);
    expand([&](const std::string& part) { return part == "chain"; });
    expand([&](const std::string& part) { return !has_frame(part) && part != "chain"; });
    for (Document& document : documents_) {
      Node* studies = document.root.find("study");
      if (studies == nullptr) continue;
      for (std::size_t n = 0; n < studies->items.size(); ++n)
        if (Node* loads = studies->items[n].find("loads"))
          expand_list(*loads, "study[" + std::to_string(n + 1) + "].loads", {}, 0);
    }
    return unused_templates();
  }

 private:
  void collect_names(const Node& root) {
    const Node* parameters = root.find("parameters");
    if (!parameters) return;
    for (const NodeEntry& entry : parameters->entries) parameters_.insert(entry.key);
  }

  void collect_templates(const Node& root) {
    const Node* templates = root.find("template");
    if (!templates) return;
    if (templates->kind != Node::Kind::table)
      return problems_.add(templates->place, "template",
                           "got " + described(*templates) + ", need tables [template.name]");
    for (const NodeEntry& entry : templates->entries) {
      if (entry.value.kind != Node::Kind::table)
        problems_.add(
            entry.value.place, "template." + entry.key,
            "got " + described(entry.value) + ", need a table [template." + entry.key + "]");
      else
        templates_[entry.key] = &entry.value;
    }
  }

  /// Every name that a template has a default for stands in it.
  void check_defaults(const std::string& name, const Node& table) {
    const Node* defaults = table.find("with");
    if (!defaults || defaults->kind != Node::Kind::table) return;
    for (const NodeEntry& entry : defaults->entries)
      if (!stands_in(table, entry.key, 0))
        problems_.add(entry.place, "template." + name + ".with." + entry.key,
                      "stands nowhere in the template, need a formula or braces that name it");
  }

  /// In what the table says, or in templates that it uses.
  bool stands_in(const Node& node, const std::string& name, std::size_t depth) const {
    if (node.kind == Node::Kind::text && mentions(node.text, name)) return true;
    if (std::any_of(node.items.begin(), node.items.end(),
                    [&](const Node& item) { return stands_in(item, name, depth); }))
      return true;
    const Node* defaults = depth == 0 ? node.find("with") : nullptr;
    if (std::any_of(node.entries.begin(), node.entries.end(), [&](const NodeEntry& entry) {
          return &entry.value != defaults && stands_in(entry.value, name, depth + 1);
        }))
      return true;
    const Node* use = node.find("use");
    const auto found = use ? templates_.find(use->text) : templates_.end();
    return found != templates_.end() && depth < most_levels &&
           stands_in(*found->second, name, depth + 1);
  }

  /// Of the case file itself: files that it includes may hold more than it needs.
  std::vector<std::string> unused_templates() const {
    std::vector<std::string> hints;
    const Node* own = documents_.back().root.find("template");
    if (own == nullptr) return hints;
    for (const NodeEntry& entry : own->entries)
      if (used_.count(entry.key) == 0)
        hints.push_back(place_text(entry.place, "template." + entry.key) +
                        ": nothing uses it, so its keys were not read");
    return hints;
  }

  /// Copies of all tables of a list, in order. Groups of elements are laid out one after the other.
  void expand_list(Node& list, const std::string& key, const Shared& outer, std::size_t depth) {
    if (list.kind != Node::Kind::array || !is_asked_for(list, outer)) return;
    std::vector<Node> copies;
    for (std::size_t n = 0; n < list.items.size(); ++n)
      expand_item(list.items[n], key, std::to_string(n + 1), outer, depth, copies);
    list.items = std::move(copies);
  }

  static bool is_asked_for(const Node& list, const Shared& outer) {
    return outer || std::any_of(list.items.begin(), list.items.end(), [](const Node& item) {
             if (item.find("repeat") || item.find("pattern") || item.find("use")) return true;
             const Node* inner = item.find("elements");
             return inner && is_asked_for(*inner, {});
           });
  }

  void expand_item(const Node& item, const std::string& key, const std::string& number,
                   const Shared& outer, std::size_t depth, std::vector<Node>& copies) {
    const std::string own_key = key + "[" + number + "]";
    if (depth > most_levels)
      return problems_.add(item.place, own_key,
                           "templates or groups within each other, more than " +
                               std::to_string(most_levels) + " deep");
    const auto ranges = ranges_of(item, own_key, parameters_, outer.get(), problems_);
    if (!ranges) return;
    std::size_t count = 1;
    for (const IndexRange& range : *ranges)
      count = std::min(count * range.count(), most_copies + 1);
    if (count > most_copies)
      return problems_.add(
          (item.find("repeat") ? item.find("repeat") : item.find("pattern"))->place,
          own_key + (item.find("repeat") ? ".repeat" : ".pattern"),
          "got more than " + std::to_string(most_copies) + " copies, need at most as many");
    for (std::size_t c = 0; c < count; ++c) {
      Bindings bindings = outer ? *outer : Bindings{};
      std::string text = number;
      std::size_t rest = c, weight = count;
      for (const IndexRange& range : *ranges) {  // the last one runs fastest
        weight /= range.count();
        const long index = range.first + range.step * static_cast<long>(rest / weight);
        rest %= weight;
        text += ", " + range.name + " = " + std::to_string(index);
        bindings.list.push_back({range.name, std::to_string(index), index});
      }
      if (!add_copy(item, key, text, std::make_shared<const Bindings>(std::move(bindings)), depth,
                    copies))
        return;
    }
  }

  /// @returns whether more copies may follow
  bool add_copy(const Node& item, const std::string& key, const std::string& number,
                const Shared& bindings, std::size_t depth, std::vector<Node>& copies) {
    values_ += size_of(item);
    const std::string own_key = key + "[" + number + "]";
    if (values_ > most_values) return refuse_more(item.place, own_key);
    Node copy = item;
    copy.number_text = number;
    if (copy.kind == Node::Kind::table) {
      remove_key(copy, "repeat");
      remove_key(copy, "pattern");
      fill(copy, own_key, bindings, depth);
      if (!apply_template(copy, own_key, bindings, depth)) return false;
      if (const Node* pattern = item.find("pattern")) {
        const std::string index = index_of(*pattern);
        const Node at_zero = copy_at_zero(item, own_key, *bindings, index, depth);
        turn_copy({copy, key, *pattern, index, *bindings, at_zero, own_key}, drawn_, problems_);
      }
      // A group: elements that are no chain of their own.
      Node* elements = copy.find("elements");
      const bool is_group = elements && key.ends_with(".elements");
      if (is_group) {
        for (const NodeEntry& entry : copy.entries)
          if (entry.key != "elements")
            problems_.add(entry.place, own_key + "." + entry.key,
                          "has no meaning in a group, need elements and repeat alone");
        for (std::size_t n = 0; n < elements->items.size(); ++n) {
          Node& part = elements->items[n];
          part.number_text =
              number + ", " + (part.number_text.empty() ? std::to_string(n + 1) : part.number_text);
          copies.push_back(std::move(part));
        }
        return true;
      }
    }
    copies.push_back(std::move(copy));
    return true;
  }

  /// The copy of a pattern that would not be turned, for the names in it. It may be one that the case has not.
  Node copy_at_zero(const Node& item, const std::string& key, Bindings bindings,
                    const std::string& index, std::size_t depth) {
    for (Binding& binding : bindings.list)
      if (binding.name == index) binding = {.name = index, .text = "0", .whole = 0};
    Problems unheard;  // the copies that the case has are judged
    const std::size_t values = values_;
    const bool is_full = is_full_;
    Node copy = item;
    const auto shared = std::make_shared<const Bindings>(std::move(bindings));
    std::swap(problems_, unheard);
    fill(copy, key, shared, depth);
    apply_template(copy, key, shared, depth);
    std::swap(problems_, unheard);
    values_ = values;
    is_full_ = is_full;
    return copy;
  }

  /// Adds what the template says and the table does not.
  bool apply_template(Node& table, const std::string& key, const Shared& outer, std::size_t depth) {
    const Node* use = table.find("use");
    const Node* with = table.find("with");
    if (!use) {
      if (with) problems_.add(with->place, key + ".with", "goes with use, need use = \"...\"");
      return !with;
    }
    const auto found =
        use->kind == Node::Kind::text ? templates_.find(use->text) : templates_.end();
    if (found == templates_.end()) {
      std::vector<std::string> known;
      for (const auto& entry : templates_) known.push_back(entry.first);
      problems_.add(use->place, key + ".use",
                    "got " + described(*use) + ", need the name of a [template.name]" +
                        suggestion(use->text, known));
      return false;
    }
    used_.insert(found->first);
    Bindings bindings = outer ? *outer : Bindings{};
    Bindings own;
    const Node& from = *found->second;
    const Node* defaults = from.find("with");
    if (defaults && !bind(*defaults, "template." + use->text + ".with", {}, nullptr, own))
      return false;
    if (with && !bind(*with, key + ".with", outer, &from, own)) return false;
    for (Binding& binding : own.list) bindings.list.push_back(std::move(binding));
    const auto inner = std::make_shared<const Bindings>(std::move(bindings));
    remove_key(table, "use");
    remove_key(table, "with");
    Node more;
    for (const NodeEntry& entry : from.entries)
      if (entry.key != "with" && !table.find(entry.key)) more.entries.push_back(entry);
    values_ += size_of(more);
    if (values_ > most_values) return refuse_more(table.place, key);
    fill(more, key, inner, depth + 1);
    for (NodeEntry& entry : more.entries) table.entries.push_back(std::move(entry));
    if (!table.find("use")) return true;
    if (depth < most_levels) return apply_template(table, key, inner, depth + 1);
    problems_.add(table.place, key, "templates that use each other in a circle");
    return false;
  }

  /// Says once that there is too much. @returns false
  bool refuse_more(const Place& place, const std::string& key) {
    if (!is_full_)
      problems_.add(place, key,
                    "more than " + std::to_string(most_values) +
                        " keys and values with all repetitions, need fewer");
    is_full_ = true;
    return false;
  }

  /// @param from  the template that names are given to: those that do not stand in it would bind nothing
  bool bind(const Node& with, const std::string& key, const Shared& outer, const Node* from,
            Bindings& own) {
    const Node* defaults = from ? from->find("with") : nullptr;
    if (with.kind != Node::Kind::table) {
      problems_.add(with.place, key,
                    "got " + described(with) + ", need a table such as { angle = \"30*deg\" }");
      return false;
    }
    bool good = true;
    for (const NodeEntry& entry : with.entries) {
      const std::string entry_key = key + "." + entry.key;
      const Node& value = entry.value;
      const bool usable = value.kind == Node::Kind::number || value.kind == Node::Kind::text;
      if (!is_identifier(entry.key) || is_formula_word(entry.key))
        problems_.add(entry.place, entry_key,
                      "need a name of letters, digits and '_' that formulas do not keep for "
                      "themselves");
      else if (!usable)
        problems_.add(value.place, entry_key,
                      "got " + described(value) + ", need a number, a formula or a name");
      else if (defaults && !defaults->find(entry.key))
        problems_.add(entry.place, entry_key,
                      "no such name in the template" + suggestion(entry.key, keys_of(*defaults)));
      else if (from && !defaults && !stands_in(*from, entry.key, 0))
        problems_.add(entry.place, entry_key,
                      "stands nowhere in the template, need a name that it uses");
      else {
        own.list.push_back(binding_of(entry, entry_key, outer));
        continue;
      }
      good = false;
    }
    return good;
  }

  static std::vector<std::string> keys_of(const Node& table) {
    std::vector<std::string> keys;
    for (const NodeEntry& entry : table.entries) keys.push_back(entry.key);
    return keys;
  }

  static Binding binding_of(const NodeEntry& entry, const std::string& key, const Shared& outer) {
    Binding binding{.name = entry.key};
    const Node& value = entry.value;
    if (value.kind == Node::Kind::text) {
      binding.text = outer ? with_bindings(value.text, *outer) : value.text;
      binding.parts = written_parts(value);
      binding.parts.push_back({binding.text, described(value), value.place, key, ""});
      return binding;
    }
    binding.text = shortest(value.number);
    if (std::floor(value.number) == value.number && std::abs(value.number) <= largest_index)
      binding.whole = static_cast<long>(value.number);
    return binding;
  }

  /// Fills braces and binds names in all values of the table; lists within are expanded.
  void fill(Node& node, const std::string& key, const Shared& bindings, std::size_t depth) {
    if (node.kind == Node::Kind::text && !bindings->list.empty()) {
      FilledText text = filled(node.text, *bindings);
      if (!text.problem.empty())
        problems_.add(node.place, key, "got " + described(node) + ": " + text.problem);
      node.text = std::move(text.text);
      node.bindings = bindings;
    }
    for (std::size_t n = 0; n < node.items.size(); ++n)
      fill(node.items[n], key + "[" + std::to_string(n + 1) + "]", bindings, depth);
    for (NodeEntry& entry : node.entries) {
      const std::string entry_key = key + "." + entry.key;
      const bool list = entry.key == "elements" && entry.value.kind == Node::Kind::array;
      if (list)
        expand_list(entry.value, entry_key, bindings, depth + 1);
      else
        fill(entry.value, entry_key, bindings, depth);
    }
  }

  std::vector<Document>& documents_;
  Problems& problems_;
  std::set<std::string> parameters_{};
  std::map<std::string, const Node*> templates_{};
  std::set<std::string> used_{};  ///< names of templates
  DrawnParts drawn_{};
  std::size_t values_ = 0;
  bool is_full_ = false;  ///< there are too many values: nothing more is copied
};

}  // namespace

const std::vector<std::string>& parts_of_mechanism() {
  static const std::vector<std::string> parts{"body", "node", "chain", "spring", "bar", "load"};
  return parts;
}

std::vector<std::string> expand_repetitions(std::vector<Document>& documents, Problems& problems) {
  return Expander{documents, problems}.run();
}

}  // namespace springfold::io
