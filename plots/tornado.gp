# A figure of relative sensitivities: one bar for every parameter, the largest at the top.
#
# The program has set before this file is read:
#   figure_name, figure_title, x_title   texts; figure_title_mode, x_title_mode as in style.gp
#   bars            number of bars; bar n has parameter[n] (its name), value[n], shown[n] (the value as text)
#   figure_format, figure_font, figure_font_size   as in style.gp
#   figure_width, figure_height   size in pixels; 0: as large as it needs
#   left_out        parameters without a bar and why, or ''
# style.gp is read before this file.

scale = figure_font_size / 14.0
top = 80.0 * scale; bottom = (95.0 + (left_out eq '' ? 0 : 24.0)) * scale
least_row = 12.0
figure_width = figure_width > 0 ? figure_width : 1000.0
row = figure_height > 0 ? (figure_height - top - bottom) / bars : 46.0 * scale
row = row < least_row ? least_row : row
figure_height = top + row * bars + bottom

# Names stand at the left, room for values on both sides of the bars.
low = 0.0; high = 0.0; longest = 0
do for [i = 1:bars] {
  low = value[i] < low ? value[i] : low
  high = value[i] > high ? value[i] : high
  longest = strlen(parameter[i]) > longest ? strlen(parameter[i]) : longest
}
width = high - low > 0 ? high - low : 1
set xrange [low - (low < 0 ? 0.16 : 0.02) * width : high + (high > 0 ? 0.16 : 0.02) * width]
set yrange [bars + 0.5 : 0.5]
set lmargin at screen (40.0 + 11.0 * longest) * scale / figure_width
set rmargin at screen 0.97
set bmargin at screen bottom / figure_height
set tmargin at screen (figure_height - top) / figure_height

set border 1
unset ytics
set grid noytics xtics back linestyle 3
unset key
set title figure_title @figure_title_mode font title_font textcolor rgb ink offset 0, 0.6
set xlabel x_title @x_title_mode textcolor rgb ink offset 0, -0.2
set arrow from first 0, graph 0 to first 0, graph 1 nohead linestyle 5 linewidth 1.5 front
do for [i = 1:bars] {
  color = value[i] < 0 ? driven_color : stable_color
  set object i rectangle from first 0, first i - 0.34 to first value[i], first i + 0.34 \
      fillcolor rgb color fillstyle solid noborder
  set label 2 * i parameter[i] at graph 0, first i right noenhanced offset -1.2, 0 textcolor rgb ink
  if (value[i] < 0) {
    set label 2 * i + 1 shown[i] at first value[i], first i right noenhanced offset -0.6, 0 \
        font point_label_font textcolor rgb ink
  } else {
    set label 2 * i + 1 shown[i] at first value[i], first i left noenhanced offset 0.6, 0 \
        font point_label_font textcolor rgb ink
  }
}
if (left_out ne '') set label 1 left_out at screen 0.5, screen 18 * scale / figure_height center noenhanced \
    font point_label_font textcolor rgb '#777777'

figure_terminal = terminal_of(figure_format)
set terminal @figure_terminal
set output output_of(figure_format)
plot NaN notitle
unset output
