#include "overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "stability_parts.hpp"

namespace springfold::io {
namespace {

// All in pixels.
constexpr double piece_length = 3;       // curves are looked at in pieces of about this length
constexpr double line_width = 2;         // nearer lines lie on each other
constexpr double cell_size = 4;          // of the grid in which near pieces are looked up
constexpr double shortest_overlap = 18;  // about one period of the shorter dashes
constexpr double same_turn = 40;         // along one line: nearer pieces belong to the same turn
constexpr double parallel = 0.25;  // sine of the largest angle between lines that lie on each other

struct Piece {
  PlotPoint middle{}, direction{};  ///< [pixel], unit vector
  std::size_t line = 0;             ///< which curve
  double along = 0;  ///< way from its begin, all its parts one after the other [pixel]
  Stability stability = Stability::stable;
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
            if (pieces_[k].stability < piece.stability) return Cover::better;
            cover = Cover::alike;
          }
      }
    return cover;
  }

 private:
  static std::pair<std::int64_t, std::int64_t> cell_of(const PlotPoint& at) {
    return {static_cast<std::int64_t>(std::floor(at.first / cell_size)),
            static_cast<std::int64_t>(std::floor(at.second / cell_size))};
  }
  static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return (static_cast<std::uint64_t>(i) << 32U) ^ (static_cast<std::uint64_t>(j) & 0xffffffffU);
  }
  static bool lies_on(const Piece& a, const Piece& b) {
    if (a.line == b.line && std::abs(a.along - b.along) < same_turn) return false;
    const PlotPoint gap{a.middle.first - b.middle.first, a.middle.second - b.middle.second};
    const double across = gap.first * b.direction.second - gap.second * b.direction.first;
    const double turn =
        a.direction.first * b.direction.second - a.direction.second * b.direction.first;
    return std::abs(across) < line_width && std::hypot(gap.first, gap.second) < cell_size &&
           std::abs(turn) < parallel;
  }

  std::vector<Piece> pieces_{};
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_{};
};

/// A part of a curve in short pieces, with their ends in the units of the axes.
struct CutLine {
  std::vector<PlotPoint> ends{};  ///< one more than pieces
  std::vector<Piece> pieces{};
  double end = 0;  ///< way from the curve's begin
};

bool is_near_frame(const PlotPoint& p, const Canvas& canvas) {
  return p.first > -canvas.width && p.first < 2 * canvas.width && p.second > -canvas.height &&
         p.second < 2 * canvas.height;
}

CutLine cut(const Figure& figure, const Canvas& canvas, const CurvePart& part, std::size_t line,
            double along) {
  CutLine all;
  for (std::size_t i = 0; i + 1 < part.line.size(); ++i) {
    const PlotPoint a = in_pixels(figure, canvas, part.line[i]);
    const PlotPoint b = in_pixels(figure, canvas, part.line[i + 1]);
    const double length = std::hypot(b.first - a.first, b.second - a.second);
    const bool is_seen =
        is_finite(a) && is_finite(b) && (is_near_frame(a, canvas) || is_near_frame(b, canvas));
    const auto count = is_seen && length < canvas.width + canvas.height
                           ? static_cast<std::size_t>(std::ceil(length / piece_length))
                           : 1;
    if (all.ends.empty()) all.ends.push_back(part.line[i]);
    for (std::size_t k = 0; k < std::max<std::size_t>(count, 1); ++k) {
      const double n = static_cast<double>(std::max<std::size_t>(count, 1));
      const double t = (static_cast<double>(k) + 0.5) / n, end = (static_cast<double>(k) + 1) / n;
      Piece piece{.line = line, .along = along + t * length, .stability = part.stability};
      piece.middle = {a.first + t * (b.first - a.first), a.second + t * (b.second - a.second)};
      if (length > 0)
        piece.direction = {(b.first - a.first) / length, (b.second - a.second) / length};
      if (!is_finite(piece.middle)) piece.middle = {-1e6, -1e6};
      all.pieces.push_back(piece);
      all.ends.push_back(end == 1 ? part.line[i + 1]
                                  : from_pixels(figure, canvas,
                                                {a.first + end * (b.first - a.first),
                                                 a.second + end * (b.second - a.second)}));
    }
    if (std::isfinite(length)) along += length;
  }
  all.end = along;
  return all;
}

/// Covers that are too short to be more than a crossing do not count.
void drop_short(const CutLine& line, std::vector<Cover>& covers) {
  for (std::size_t begin = 0; begin < covers.size();) {
    std::size_t end = begin;
    while (end < covers.size() && (covers[end] == Cover::none) == (covers[begin] == Cover::none))
      ++end;
    const bool is_whole = begin == 0 && end == covers.size();
    const double length = line.pieces[end - 1].along - line.pieces[begin].along;
    if (covers[begin] != Cover::none && !is_whole && length < shortest_overlap)
      std::fill(covers.begin() + static_cast<std::ptrdiff_t>(begin),
                covers.begin() + static_cast<std::ptrdiff_t>(end), Cover::none);
    begin = end;
  }
}

/// The stretches of a part that are drawn, and those along which it lies on a more stable line.
void add_stretches(const CurvePart& part, const CutLine& line, const std::vector<Cover>& covers,
                   std::vector<CurvePart>& kept, std::vector<Polyline>& mixed) {
  if (std::all_of(covers.begin(), covers.end(), [](Cover c) { return c == Cover::none; }))
    return kept.push_back(part);  // with its own points
  for (std::size_t begin = 0; begin < covers.size();) {
    std::size_t end = begin;
    while (end < covers.size() && covers[end] == covers[begin]) ++end;
    const Polyline stretch(line.ends.begin() + static_cast<std::ptrdiff_t>(begin),
                           line.ends.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    if (covers[begin] == Cover::none) kept.push_back({part.stability, stretch});
    if (covers[begin] == Cover::better) mixed.push_back(stretch);
    begin = end;
  }
}

}  // namespace

DrawnLines without_overlaps(const Figure& figure, const Canvas& canvas) {
  DrawnLines lines;
  lines.curves.resize(figure.curves.size());
  Drawn drawn;
  for (const auto level :
       {Stability::stable, Stability::unknown, Stability::driven, Stability::unstable})
    for (std::size_t c = 0; c < figure.curves.size(); ++c) {
      double along =
          0;  // at a limit point the stable part ends where the unstable one begins: that is no overlap
      for (const CurvePart& part : figure.curves[c].parts) {
        const CutLine line = cut(figure, canvas, part, c, along);
        along = line.end;
        if (part.stability != level) continue;
        std::vector<Cover> covers;
        // Solid lines do not fill each other's gaps: all are drawn. A dashed line may lie on itself.
        for (const Piece& piece : line.pieces) {
          covers.push_back(level == Stability::stable ? Cover::none : drawn.cover_of(piece));
          drawn.add(piece);
        }
        drop_short(line, covers);
        add_stretches(part, line, covers, lines.curves[c], lines.mixed);
      }
    }
  return lines;
}

}  // namespace springfold::io
