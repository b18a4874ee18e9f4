#include "springfold/drawing/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "glyphs.hpp"

namespace springfold::drawing {
namespace {

// All in pixels.
constexpr double piece_length = 3;       // lines are looked at in pieces of about this length
constexpr double line_width = 2;         // nearer lines lie on each other
constexpr double cell_size = 4;          // of the grid in which near pieces are looked up
constexpr double shortest_overlap = 18;  // about one period of the shorter dashes
constexpr double same_turn = 40;         // along one curve: nearer pieces belong to the same turn
constexpr double same_way = 0.5;         // nearer ones of one turn run back on the same way
constexpr double parallel = 0.25;  // sine of the largest angle between lines that lie on each other

struct Piece {
  Place middle{}, direction{};  ///< [px], unit vector
  std::size_t curve = 0;
  double along = 0;  ///< way from the curve's begin, all its lines one after the other [px]
  int rank = 0;
};

enum class Cover { none, alike, better };

/// Pieces that are drawn, found by their places.
class Drawn {
 public:
  void add(const Piece& piece) {
    const auto [i, j] = cell_of(piece.middle);
    cells_[key(i, j)].push_back(pieces_.size());
    pieces_.push_back(piece);
  }

  Cover cover_of(const Piece& piece) const {
    const auto [i, j] = cell_of(piece.middle);
    Cover cover = Cover::none;
    for (std::int64_t di = -1; di <= 1; ++di)
      for (std::int64_t dj = -1; dj <= 1; ++dj) {
        const auto found = cells_.find(key(i + di, j + dj));
        if (found == cells_.end()) continue;
        for (const std::size_t k : found->second)
          if (lies_on(pieces_[k], piece)) {
            if (pieces_[k].rank < piece.rank) return Cover::better;
            cover = Cover::alike;
          }
      }
    return cover;
  }

 private:
  static std::pair<std::int64_t, std::int64_t> cell_of(const Place& at) {
    return {static_cast<std::int64_t>(std::floor(at.x / cell_size)),
            static_cast<std::int64_t>(std::floor(at.y / cell_size))};
  }
  static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return (static_cast<std::uint64_t>(i) << 32U) ^ (static_cast<std::uint64_t>(j) & 0xffffffffU);
  }
  static bool lies_on(const Piece& a, const Piece& b) {
    const Place gap = a.middle - b.middle;
    const double across = gap.x * b.direction.y - gap.y * b.direction.x;
    const double turn = a.direction.x * b.direction.y - a.direction.y * b.direction.x;
    if (a.curve == b.curve && std::abs(a.along - b.along) < same_turn) {
      const bool is_back = a.direction.x * b.direction.x + a.direction.y * b.direction.y < 0;
      if (a.rank != b.rank || !is_back || std::abs(across) >= same_way) return false;
    }
    return std::abs(across) < line_width && length(gap) < cell_size && std::abs(turn) < parallel;
  }

  std::vector<Piece> pieces_{};
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_{};
};

/// A line in short pieces.
struct CutLine {
  Stretch ends{};  ///< one more than pieces
  std::vector<Piece> pieces{};
};

bool is_finite(const Place& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

CutLine cut(const RankedLine& line, double width, double height, double along) {
  const auto is_near_frame = [&](const Place& p) {
    return p.x > -width && p.x < 2 * width && p.y > -height && p.y < 2 * height;
  };
  CutLine all;
  for (std::size_t i = 0; i + 1 < line.places.size(); ++i) {
    const Place a = line.places[i], b = line.places[i + 1];
    const double size = length(b - a);
    const bool is_seen = is_finite(a) && is_finite(b) && (is_near_frame(a) || is_near_frame(b));
    const auto count =
        is_seen && size < width + height
            ? std::max<std::size_t>(static_cast<std::size_t>(std::ceil(size / piece_length)), 1)
            : 1;
    const auto add_end = [&](const Place& at, double part) {
      all.ends.places.push_back(at);
      all.ends.numbers.push_back(static_cast<double>(i) + part);
    };
    if (i == 0) add_end(a, 0);
    for (std::size_t k = 0; k < count; ++k) {
      const double n = static_cast<double>(count);
      const double t = (static_cast<double>(k) + 0.5) / n, end = (static_cast<double>(k) + 1) / n;
      Piece piece{.middle = a + t * (b - a),
                  .curve = line.curve,
                  .along = along + t * size,
                  .rank = line.rank};
      if (size > 0) piece.direction = (1 / size) * (b - a);
      if (!is_finite(piece.middle)) piece.middle = {-1e6, -1e6};
      all.pieces.push_back(piece);
      add_end(end == 1 ? b : a + end * (b - a), end);
    }
    if (std::isfinite(size)) along += size;
  }
  return all;
}

double length_of(const CutLine& line, std::size_t begin, std::size_t end) {
  return line.pieces[end - 1].along - line.pieces[begin].along;
}

/// Two curves that lie on each other lose their stability at one place: there the end of one's stable line comes near
/// the begin of the other's unstable line, which lies on a line like itself.
void drop_short_better(const CutLine& line, std::vector<Cover>& covers) {
  for (std::size_t begin = 0; begin < covers.size();) {
    std::size_t end = begin;
    while (end < covers.size() && covers[end] == covers[begin]) ++end;
    const bool is_beside_alike = (begin > 0 && covers[begin - 1] == Cover::alike) ||
                                 (end < covers.size() && covers[end] == Cover::alike);
    if (covers[begin] == Cover::better && is_beside_alike &&
        length_of(line, begin, end) < shortest_overlap)
      std::fill(covers.begin() + static_cast<std::ptrdiff_t>(begin),
                covers.begin() + static_cast<std::ptrdiff_t>(end), Cover::alike);
    begin = end;
  }
}

/// Covers that are too short to be more than a crossing do not count.
void drop_short(const CutLine& line, std::vector<Cover>& covers) {
  for (std::size_t begin = 0; begin < covers.size();) {
    std::size_t end = begin;
    while (end < covers.size() && (covers[end] == Cover::none) == (covers[begin] == Cover::none))
      ++end;
    const bool is_whole = begin == 0 && end == covers.size();
    if (covers[begin] != Cover::none && !is_whole && length_of(line, begin, end) < shortest_overlap)
      std::fill(covers.begin() + static_cast<std::ptrdiff_t>(begin),
                covers.begin() + static_cast<std::ptrdiff_t>(end), Cover::none);
    begin = end;
  }
}

template <typename T>
std::vector<T> part_of(const std::vector<T>& all, std::size_t begin, std::size_t end) {
  return {all.begin() + static_cast<std::ptrdiff_t>(begin),
          all.begin() + static_cast<std::ptrdiff_t>(end)};
}

SeenLine seen_of(const CutLine& line, const std::vector<Cover>& covers) {
  SeenLine seen;
  if (std::all_of(covers.begin(), covers.end(), [](Cover c) { return c == Cover::none; }))
    return seen;
  seen.is_whole = false;
  for (std::size_t begin = 0; begin < covers.size();) {
    std::size_t end = begin;
    while (end < covers.size() && covers[end] == covers[begin]) ++end;
    const Stretch stretch{part_of(line.ends.places, begin, end + 1),
                          part_of(line.ends.numbers, begin, end + 1)};
    if (covers[begin] == Cover::none) seen.stretches.push_back(stretch);
    if (covers[begin] == Cover::better) seen.beneath.push_back(stretch);
    begin = end;
  }
  return seen;
}

}  // namespace

std::vector<SeenLine> without_overlaps(const std::vector<RankedLine>& lines, double width,
                                       double height) {
  // At a limit point the stable line ends where the unstable one begins: that is no overlap.
  std::vector<double> begins;
  std::unordered_map<std::size_t, double> ways;
  for (const RankedLine& line : lines) {
    double& way = ways[line.curve];
    begins.push_back(way);
    for (std::size_t i = 0; i + 1 < line.places.size(); ++i)
      if (const double size = length(line.places[i + 1] - line.places[i]); std::isfinite(size))
        way += size;
  }
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lines[a].rank < lines[b].rank; });
  std::vector<SeenLine> seen(lines.size());
  Drawn drawn;
  for (const std::size_t i : order) {
    const CutLine line = cut(lines[i], width, height, begins[i]);
    std::vector<Cover> covers;
    // Solid lines do not fill each other's gaps: all are drawn. A dashed line may lie on itself.
    for (const Piece& piece : line.pieces) {
      covers.push_back(lines[i].rank == 0 ? Cover::none : drawn.cover_of(piece));
      drawn.add(piece);
    }
    drop_short(line, covers);
    drop_short_better(line, covers);
    seen[i] = seen_of(line, covers);
  }
  return seen;
}

}  // namespace springfold::drawing
