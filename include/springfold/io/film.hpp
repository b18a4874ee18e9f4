// Rows of a branch as a film: the way along it, or the mode at one of its special points.
#pragma once

#include <string>

#include "springfold/analysis/result.hpp"
#include "springfold/drawing/movie.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

struct FilmWish {
  std::string from{},
      to{};  ///< labels of special points, "start", "end"; empty: the ends of the branch
  std::string
      mode{};  ///< label of a limit point or branch point ("BP1.2": its second one): a mode instead of a way
  int branch = 0;      ///< number from 1; 0: the first that has these labels
  std::string jump{};  ///< label of a jump: the overdamped motion from it to its landing instead
  int frames = 60;     ///< at most as many, 2 or more
};

/// The film, or in words why there is none.
struct FilmOutcome {
  drawing::Film film{};
  std::string problem{};
  bool has_start = true;  ///< false: the study has no first equilibrium
};

/// Of one branch of the result. A way has its frames at even arc length: each is the row that is nearest, and special
/// points are among them. Nothing is put between rows. A mode is the motion along the branch at a limit point, or along
/// a null vector at a branch point, to and fro and enlarged, linear in the places of all points. A jump has the moments
/// that the result has, and its energy over the length of way beside it.
FilmOutcome film_of(const PlannedRun& planned, const analysis::StudyResult& result,
                    const UnitLabels& units, const FilmWish& wish);

/// The same run with rows at even distances too, as many as the film has frames.
PlannedRun with_rows_for(const FilmWish& wish, PlannedRun planned,
                         const analysis::StudyResult& result);

}  // namespace springfold::io
