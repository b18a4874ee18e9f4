# Look of all figures of springfold. Edit freely: the program reads this file when it draws.
#
# The program has set before this file is read:
#   figure_name, figure_title, x_title, y_title        texts
#   figure_title_mode, x_title_mode, y_title_mode      'noenhanced', or 'enhanced' for a text in gnuplot's markup
#   x_low, x_high, y_low, y_high                       ends of the axes
#   figure_width, figure_height                        size in pixels
#   figure_format                                      'png', 'svg', 'pdf' or 'tikz'
#   figure_font, figure_font_size                      name, and points
#   frame_left, frame_right, frame_bottom, frame_top   frame of the axes, in parts of the size
# It has placed all labels for this size and frame and for the font sizes below. Other sizes work,
# but labels may then touch curves.

set encoding utf8
unset colorbox

# Colours that stay apart for colour-blind readers and in grey print.
stable_color = '#0072B2'
driven_color = '#D55E00'
unstable_color = '#D55E00'
mixed_color = '#F5CBA7'
# Shaded parts: where nothing unwanted happens, and where it happens whatever is done.
wanted_tint = '#E1EEF7'
unwanted_tint = '#F7E3D4'
# Branches of a diagram, one after the other.
branch_colors = '#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9 #882255 #999933'
ink = '#222222'
pale = '#D9D9D9'

# LaTeX has fonts of its own: a name would be printed as a text.
sized(points) = figure_format eq 'tikz' ? '' : sprintf('%s,%g', figure_font, points)
base_font = sized(figure_font_size)
# A text that is longer than its room gets smaller letters: those of most fonts are about 0.62 of their size wide, of a
# point 96 / 72 pixels. A room of 0 is not known yet.
fitted(text, points, room) = room > 0 && strlen(text) * 0.62 * points * 96 / 72.0 > room ? \
    room / (strlen(text) * 0.62 * 96 / 72.0) : points
title_font = sized(fitted(figure_title, figure_font_size + 4, 0.9 * figure_width))
key_font = sized(figure_font_size - 1)
point_label_font = sized(figure_font_size - 1)
point_label_color = ink
curve_label_font = sized(figure_font_size)
curve_label_color = ink

# The terminal of each format, once the size is known. SVG sizes its text in pixels, PNG in points: 96 pixels stand for
# 72 points, and for an inch. That of LaTeX takes numbers only, no names of them.
terminal_of(format) = \
    format eq 'png' ? "pngcairo size figure_width, figure_height font base_font background rgb 'white'" : \
    format eq 'svg' ? "svg size figure_width, figure_height font base_font fontscale 96.0 / 72.0 ". \
                      "background rgb 'white'" : \
    format eq 'pdf' ? "pdfcairo size figure_width / 96.0, figure_height / 96.0 font base_font linewidth 0.75" : \
    sprintf('tikz size %gin,%gin standalone', figure_width / 96.0, figure_height / 96.0)
output_of(format) = figure_name.'.'.(format eq 'tikz' ? 'tex' : format)

# SVG draws dashes twice as long as the other formats do: longer than a line of the key, which would look solid.
dash_scale = figure_format eq 'svg' ? 0.5 : 1.0

# 1 stable, 2 unstable as held in the study, 6 unstable under dead load, 8 stability not known, 7 beneath a line on
# which a less stable one lies, 3 grid, 4 line from a label to its point, 5 axes through zero, 9 end of that line
set style line 1 linecolor rgb stable_color linewidth 3.2 dashtype solid
set style line 2 linecolor rgb unstable_color linewidth 3.2 dashtype (4 * dash_scale, 5 * dash_scale)
set style line 6 linecolor rgb driven_color linewidth 3.2 dashtype (14 * dash_scale, 6 * dash_scale)
set style line 8 linecolor rgb ink linewidth 3.2 dashtype (14 * dash_scale, 4 * dash_scale, 3 * dash_scale, 4 * dash_scale)
set style line 7 linecolor rgb mixed_color linewidth 11 dashtype solid
set style line 3 linecolor rgb pale linewidth 0.8 dashtype solid
set style line 4 linecolor rgb '#777777' linewidth 1.0 dashtype solid
set style line 5 linecolor rgb '#999999' linewidth 1.2 dashtype solid

# SVG draws marks larger than the other formats do, diamonds most.
mark_scale = figure_format eq 'svg' ? 0.58 : 1.0
diamond_scale = figure_format eq 'svg' ? 0.41 : 1.0

# The end of the line from a curve's label, on the curve.
set style line 9 linecolor rgb ink pointtype 7 pointsize 0.9 * mark_scale

# Degeneracies of critical curves, and where their load is stationary or jumps.
set style line 25 linecolor rgb ink pointtype 13 pointsize 2.0 * diamond_scale
set style line 26 linecolor rgb ink pointtype 1 pointsize 1.9 * mark_scale linewidth 2.2

# Special points: one shape for each code.
set style line 11 linecolor rgb ink pointtype 6 pointsize 2.4 * mark_scale linewidth 2.2            # start
set style line 12 linecolor rgb ink pointtype 7 pointsize 1.9 * mark_scale                          # LP
set style line 13 linecolor rgb ink pointtype 9 pointsize 2.2 * mark_scale                          # CL
set style line 14 linecolor rgb ink pointtype 5 pointsize 1.7 * mark_scale                          # SA
set style line 15 linecolor rgb ink pointtype 13 pointsize 2.3 * diamond_scale                      # BP
set style line 16 linecolor rgb ink pointtype 11 pointsize 2.2 * mark_scale                         # KB
set style line 17 linecolor rgb ink pointtype 3 pointsize 2.2 * mark_scale linewidth 2              # KS
set style line 18 linecolor rgb ink pointtype 12 pointsize 2.2 * diamond_scale linewidth 2.2        # TP
set style line 19 linecolor rgb ink pointtype 2 pointsize 1.9 * mark_scale linewidth 2.2            # UZ
set style line 20 linecolor rgb '#CC0000' pointtype 2 pointsize 2.8 * mark_scale linewidth 3.5      # UR
set style line 21 linecolor rgb ink pointtype 4 pointsize 1.9 * mark_scale linewidth 2.2            # FM
set style line 22 linecolor rgb stable_color pointtype 7 pointsize 2.2 * mark_scale                 # ES
set style line 23 linecolor rgb unstable_color pointtype 6 pointsize 2.2 * mark_scale linewidth 2.5 # EU
set style line 24 linecolor rgb ink pointtype 8 pointsize 2.2 * mark_scale linewidth 2.2            # SC

point_style(code) = code eq 'start' ? 11 : code eq 'LP' ? 12 : code eq 'CL' ? 13 : \
                    code eq 'SA' ? 14 : code eq 'BP' ? 15 : code eq 'KB' ? 16 : \
                    code eq 'KS' ? 17 : code eq 'TP' ? 18 : code eq 'UZ' ? 19 : \
                    code eq 'FM' ? 21 : code eq 'ES' ? 22 : code eq 'EU' ? 23 : code eq 'SC' ? 24 : \
                    strstrt(' CP IC CX HT BB C2 FA CR TA AA SB PT TH ', ' '.code.' ') > 0 ? 25 : \
                    code eq 'EX' || code eq 'JP' ? 26 : 20
point_name(code) = code eq 'start' ? 'start' : \
                   code eq 'LP' ? 'limit point (LP)' : \
                   code eq 'CL' ? 'corner limit point (CL)' : \
                   code eq 'SA' ? 'spring activation (SA)' : \
                   code eq 'BP' ? 'branch point (BP)' : \
                   code eq 'KB' ? 'branching kink (KB)' : \
                   code eq 'KS' ? 'kinematic singularity (KS)' : \
                   code eq 'TP' ? 'touching point (TP)' : \
                   code eq 'FM' ? 'family (FM)' : \
                   code eq 'UZ' ? 'marked value (UZ)' : \
                   code eq 'ES' ? 'stable equilibrium (EQ)' : \
                   code eq 'EU' ? 'unstable equilibrium (EQ)' : \
                   code eq 'SC' ? 'stability changes (SC)' : \
                   code eq 'CP' ? 'cusp (CP)' : \
                   code eq 'IC' ? 'isola centre (IC)' : \
                   code eq 'CX' ? 'crossing of branches (CX)' : \
                   code eq 'HT' ? 'hilltop (HT)' : \
                   code eq 'BB' ? 'birth of branch points (BB)' : \
                   code eq 'C2' ? 'another mode (C2)' : \
                   code eq 'FA' ? 'fold meets activation (FA)' : \
                   code eq 'CR' ? 'corner loses its reversal (CR)' : \
                   code eq 'TA' ? 'touch of an activation (TA)' : \
                   code eq 'AA' ? 'two activations (AA)' : \
                   code eq 'SB' ? 'supercritical, subcritical (SB)' : \
                   code eq 'PT' ? 'turn of the parameter (PT)' : \
                   code eq 'EX' ? 'extremum (EX)' : \
                   code eq 'TH' ? 'threshold (TH)' : \
                   code eq 'JP' ? 'jump (JP)' : \
                   code eq 'UR' ? 'unresolved (UR)' : ''

set border 3 linecolor rgb ink linewidth 1.2
if (figure_format eq 'tikz') { unset minussign } else { set minussign }
set format '%g'
set tics nomirror out scale 0.7 textcolor rgb ink font base_font
set grid xtics ytics back linestyle 3
