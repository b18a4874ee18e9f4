// Keys of [[plot]] that say how the figure looks.
#pragma once

#include <string>
#include <vector>

#include "numbers.hpp"
#include "springfold/io/plot_look.hpp"
#include "table_reader.hpp"

namespace springfold::io {

struct InsetDraft {
  std::vector<NumberId> x{}, y{};  ///< two each, or none if they are wrong
};

/// The numbers of a PlotLook, still formulas.
struct PlotLookDraft {
  std::vector<NumberId> x_range{}, y_range{}, size{};  ///< two each, or none
  NumberId font_size = 0;
  std::vector<InsetDraft> insets{};  ///< as many as in the look
};

/// The keys that read_look knows.
const std::vector<std::string>& look_keys();

/// @param look  gets everything but the numbers @returns these
PlotLookDraft read_look(const TableReader& table, PlotLook& look, NumberTable& numbers,
                        Reading& reading);

/// @param values  of the table that read_look was given
void set_numbers(const PlotLookDraft& draft, const std::vector<double>& values, PlotLook& look);

/// The numbers of a SheetLook, still formulas.
struct SheetLookDraft {
  std::vector<NumberId> size{};  ///< two, or none
  NumberId font_size = 0;
};

/// The keys that read_sheet_look knows, after others.
std::vector<std::string> with_sheet_keys(std::vector<std::string> others);

/// @param look  gets everything but the numbers @returns these
SheetLookDraft read_sheet_look(const TableReader& table, SheetLook& look, NumberTable& numbers,
                               Reading& reading);

/// @param values  of the table that read_sheet_look was given
void set_numbers(const SheetLookDraft& draft, const std::vector<double>& values, SheetLook& look);

/// Key `formats`: endings of the files that are written, all of `known`.
std::vector<std::string> read_formats(const TableReader& table,
                                      const std::vector<std::string>& known,
                                      std::vector<std::string> otherwise, Reading& reading);

}  // namespace springfold::io
