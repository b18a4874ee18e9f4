// Pieces of the first critical load over a parameter, and what happens between them. Private to analysis.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case_curves.hpp"
#include "first_unwanted.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::analysis {

/// Critical loads that differ by less are the same, relative to 1 + |lambda|.
inline constexpr double same_load = 1e-8;

inline constexpr const char* another_is_first =
    "from here on another critical point comes first, or none";

/// A piece in one sense of the parameter, cut where it ends.
struct Side {
  continuation::CriticalCurve curve{};
  double end = 0;
  std::optional<continuation::Degeneracy> decides{};  ///< nothing: it ends at the range, or `jumps`
  bool stops = false;                                 ///< it could not be followed beyond
  bool jumps = false;          ///< it goes on, but another point comes first, or it is not reached
  bool another_first = false;  ///< it was cut there, or goes on in the next piece
  std::string limit{};         ///< that ends the path before it, in words
};

struct LoadPiece {
  continuation::CriticalStart start{};
  EventKind of = EventKind::limit_point;
  Side falling{}, growing{};
};

/// Does this value of the parameter alone have the critical point, as where the parameter parts the modes of a multiple
/// branch point or springs that switch at once, or makes an imperfect structure of a perfect one? Other points come to
/// it from beside.
bool stands_alone(const CaseCurves& curves, const Member& member, const SpecialPoint& point);

/// Is this what comes first on a path, on a piece of such points that has the load `lambda` there? Nothing: it is
/// unresolved, and may hide the point of the piece.
/// @param alone  it may be of another kind than its neighbours
std::optional<bool> is_of_piece(const SpecialPoint& first, EventKind of, bool alone, double lambda);
std::string why_hidden(const SpecialPoint& first);

/// May another point come first beyond this one? Not at events of the caller, nor where the load has an extremum.
bool may_decide(const continuation::CriticalHit& hit);

/// Loads at ends of pieces, where the parameter of one may differ a little from that of the other.
bool is_same_load_at_ends(double a, double b);

/// Of a point at the edge of the range.
Side side_without_way(const continuation::CriticalStart& at, const std::string& what);

/// The load at the end of a side that has points.
double load_at_end(const Side& side);

/// The ends of the pieces on either side of a value, or those of the range.
std::pair<double, double> room_beside(const std::vector<LoadPiece>& pieces, double mu, double low,
                                      double high);
void insert_in_order(LoadPiece piece, std::vector<LoadPiece>& pieces);

/// Cuts a side at one of its special points.
void end_at(Side& side, EventKind of, std::size_t hit);

/// Where two pieces meet: both sides of the jump, unless the load is the same. Where a piece jumps to none: its end.
/// @param branches  of the pieces
void say_jumps(const std::vector<LoadPiece>& pieces, double room, std::vector<Branch>& branches);

/// Where a critical point comes to the start, that is one itself: no start beyond is what was to be expected.
bool ends_at_start(const std::vector<LoadPiece>& pieces, double mu);

/// The row of a value at which what comes first stands alone, with loads beside that are others.
Branch row_alone(const CaseCurves& curves, const Member& member, const SpecialPoint& point);

/// Does one of the pieces come to this load at the value? @param room  as far as ends are told apart
bool is_reached(const CaseCurves& curves, const std::vector<LoadPiece>& pieces, double mu,
                double lambda, double room);

/// What is no longer than ends are told apart, and goes on beside it, is no piece of its own.
void leave_out_points(std::vector<LoadPiece>& pieces, double room);

/// A side that could not be followed beyond its end ends there where a next piece of its kind begins with the same
/// load.
void end_stops_where_next_begins(std::vector<LoadPiece>& pieces, double room);

/// Does a piece reach over this value, and has none of them a stop there?
/// @param room  as far as ends are told apart
bool is_settled(const std::vector<LoadPiece>& pieces, double mu, double room);

/// Where one piece meets the next one with the same load, the same point goes on, or the lesser one of two loads: both
/// end where they are equal.
/// @param alone  values with a point of their own: no piece comes to them
void say_what_goes_on(const CaseCurves& curves, const std::vector<double>& alone,
                      std::vector<LoadPiece>& pieces, double room);

}  // namespace springfold::analysis
