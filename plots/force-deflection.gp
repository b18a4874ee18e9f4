# One figure of curves: stable parts solid, unstable parts dashed, special points marked.
#
# Besides the values listed in style.gp the program has set:
#   curve_parts   names of data blocks with lines, "stable_1 stable_2 driven_1 unstable_1 ..."; the
#                 number is that of the curve; a block holds x y, empty lines between separate parts
#   curve_hues    one number per curve: 0, its colour tells its stability; n, it is the n-th branch of a
#                 diagram and has the n-th colour, its dashes tell its stability
#   first_parts   those of them that stand for the others of their kind in the key
#   point_codes   "start LP SA ...": codes that occur; block point_<code> holds x y
# Labels and their leader lines are set already.

part_style(part) = part[1:6] eq 'stable' ? 1 : part[1:6] eq 'driven' ? 6 : 2
part_kind(part) = part[1:6] eq 'stable' ? 'stable' : \
                  part[1:6] eq 'driven' ? 'unstable under dead load' : 'unstable'
part_hue(part) = part eq 'nothing' ? 0 : int(word(curve_hues, int(part[strstrt(part, '_') + 1:*])))
part_color(part) = part_hue(part) > 0 \
    ? word(branch_colors, (part_hue(part) - 1) % words(branch_colors) + 1) \
    : part[1:6] eq 'stable' ? stable_color : part[1:6] eq 'driven' ? driven_color : unstable_color
# Lines of a diagram stand in the key in ink: their colours tell branches.
is_first(part) = strstrt(' '.first_parts.' ', ' '.part.' ') > 0
key_color(part) = part_hue(part) > 0 ? ink : part_color(part)

set lmargin at screen frame_left
set rmargin at screen frame_right
set bmargin at screen frame_bottom
set tmargin at screen frame_top
set xrange [x_low:x_high]
set yrange [y_low:y_high]
if (x_low < 0 && x_high > 0) set yzeroaxis linestyle 5
if (y_low < 0 && y_high > 0) set xzeroaxis linestyle 5

set title figure_title @figure_title_mode font title_font textcolor rgb ink offset 0, 2.7
set xlabel x_title @x_title_mode textcolor rgb ink offset 0, -0.4
set ylabel y_title @y_title_mode textcolor rgb ink offset -0.6, 0
# Up to three entries in a row above the frame; three rows stand closer.
key_rows = (words(first_parts) + words(point_codes) + 2) / 3
set key at screen (frame_left + frame_right) / 2, screen frame_top + 0.07 top center \
    vertical maxrows key_rows Left reverse noenhanced samplen 3 \
    spacing (key_rows > 2 ? 0.9 : 1.25) font key_font textcolor rgb ink

set terminal pngcairo size figure_width, figure_height font base_font background rgb 'white'
set output figure_name.'.png'
plot for [part in curve_parts] '$'.part with lines linestyle part_style(part) \
         linecolor rgb part_color(part) notitle, \
     for [part in curve_parts] 1/0 with lines linestyle part_style(part) \
         linecolor rgb key_color(part) title (is_first(part) ? part_kind(part) : ''), \
     for [code in point_codes] '$point_'.code with points linestyle point_style(code) \
         title point_name(code)
unset output

# SVG sizes its text in pixels, PNG in points: 96 pixels stand for 72 points.
set terminal svg size figure_width, figure_height font base_font fontscale 96.0 / 72.0 \
    background rgb 'white'
set output figure_name.'.svg'
replot
unset output
