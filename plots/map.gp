# A figure of maps: panels side by side with one colour scale, contour lines, the edge of the
# workspace, lines at which springs switch, and lines at which stability is lost.
#
# The program has set before this file is read:
#   figure_name, figure_title, x_title, y_title, value_title, panel_title[n]   texts
#   figure_title_mode, ..., panel_title_mode   'noenhanced', or 'enhanced' for a text in gnuplot's markup
#   x_low, x_high, y_low, y_high, value_low, value_high                        ends of axes and colours
#   levels         values of the contour lines, "0.5 1 1.5"
#   panels         number of panels; panel n has the data blocks
#                  field_n      x y value, an empty line between rows of nodes; NaN: no value
#                  numbers_n    x y text: the number of a contour line
#                  contours_n, edge_n, activation_n, unstable_n   x y of line segments
#   has_gaps, has_infinite   1 if there are nodes without value, with an infinite value
#   clipped        finite values beyond the ends of the colours
#   figure_format, figure_font, figure_font_size   as in style.gp
#   figure_width, figure_height   size in pixels; 0: as large as it needs
#   has_edge, has_activation, has_unstable   1 if any panel has such lines
# style.gp is read before this file.

# Viridis (van der Walt, Smith, Firing): perceptually uniform, also in grey print and for
# colour-blind readers.
set palette defined (0 '#440154', 1 '#481a6c', 2 '#472f7d', 3 '#414487', 4 '#39568c', 5 '#31688e', \
    6 '#2a788e', 7 '#23888e', 8 '#1f988b', 9 '#22a884', 10 '#35b779', 11 '#54c568', 12 '#7ad151', \
    13 '#a5db36', 14 '#d2e21b', 15 '#fde725')
set style line 31 linecolor rgb '#FFFFFF' linewidth 1.2            # contour lines
set style line 32 linecolor rgb ink linewidth 3.0                  # edge of the workspace
set style line 33 linecolor rgb '#D55E00' linewidth 3.0 dashtype (8, 5)   # springs switch
set style line 34 linecolor rgb '#CC79A7' linewidth 3.0 dashtype (2, 4)   # stability is lost

tic_font = sized(figure_font_size - 2)
scale = figure_font_size / 14.0
left = 100.0 * scale; gap = 85.0 * scale; right = 150.0 * scale; bottom = 85.0 * scale
# Beside one panel each entry of the key takes a line, beside several two share one.
entries = has_edge + has_activation + has_unstable + has_gaps + has_infinite + (clipped > 0)
key_lines = panels > 1 ? (entries + 1) / 2 : entries
top = (50.0 + 20.0 * (key_lines < 3 ? 3 : key_lines + 0.5)) * scale
least_panel = 60.0
panel_width = figure_width > 0 ? (figure_width - left - right - (panels - 1) * gap) / panels : 470.0
panel_height = figure_height > 0 ? figure_height - bottom - top : 470.0
panel_width = panel_width < least_panel ? least_panel : panel_width
panel_height = panel_height < least_panel ? least_panel : panel_height
figure_width = left + panels * panel_width + (panels - 1) * gap + right
figure_height = bottom + panel_height + top
title_font = sized(fitted(figure_title, figure_font_size + 4, 0.9 * figure_width))

set xrange [x_low:x_high]
set yrange [y_low:y_high]
set cbrange [value_low:value_high]
set style textbox opaque noborder fillcolor rgb 'white' margins 0.4, 0.2
set border 15 linecolor rgb ink linewidth 1.2
set tics nomirror out font tic_font
unset grid
# Nodes without values stay pale.
set object 1 rectangle from graph 0, graph 0 to graph 1, graph 1 behind fillcolor rgb '#EEEEEE' \
    fillstyle solid noborder
set xlabel x_title @x_title_mode textcolor rgb ink offset 0, -0.2
set label 1 figure_title at screen 0.5, screen 1 - 24 * scale / figure_height center @figure_title_mode \
    font title_font textcolor rgb ink
set cblabel value_title @value_title_mode textcolor rgb ink offset 1.5, 0
do for [i = 1:words(levels)] {
  if (i == 1) { set cbtics (word(levels, i) real(word(levels, i))) } else { set cbtics add (word(levels, i) real(word(levels, i))) }
}

figure_terminal = terminal_of(figure_format)
# Viewers blur the picture that a vector file holds, and let it stand over the frame: rectangles keep their edges. Of very many
# nodes they would make a very large file.
most_rectangles = 20000
stats $field_1 using 1 nooutput
nodes = '' . (figure_format eq 'png' || STATS_records > most_rectangles ? 'image' : 'image pixels')
set terminal @figure_terminal
set output output_of(figure_format)
set multiplot
do for [n = 1:panels] {
  x0 = left + (n - 1) * (panel_width + gap)
  set lmargin at screen x0 / figure_width
  set rmargin at screen (x0 + panel_width) / figure_width
  set bmargin at screen bottom / figure_height
  set tmargin at screen (bottom + panel_height) / figure_height
  if (n == 1) { set ylabel y_title @y_title_mode textcolor rgb ink } else { unset ylabel }
  if (n == panels) {
    set colorbox user origin (x0 + panel_width + 18) / figure_width, bottom / figure_height \
        size 20 / figure_width, panel_height / figure_height
  } else { unset colorbox }
  set title panel_title[n] @panel_title_mode font base_font textcolor rgb ink offset 0, -0.4
  if (n == 1) {
    set key at screen 0.5, screen 1 - 40 * scale / figure_height top center horizontal noenhanced \
        samplen 3 font key_font textcolor rgb ink Left reverse
  } else { unset key }
  plot '$field_'.n using 1:2:3 with @nodes notitle, \
       '$contours_'.n with lines linestyle 31 notitle, \
       '$activation_'.n with lines linestyle 33 notitle, \
       '$unstable_'.n with lines linestyle 34 notitle, \
       '$edge_'.n with lines linestyle 32 notitle, \
       '$numbers_'.n using 1:2:3 with labels boxed font tic_font textcolor rgb ink notitle, \
       NaN with lines linestyle 32 title (has_edge ? 'edge of the workspace' : ''), \
       NaN with lines linestyle 33 title (has_activation ? 'a spring switches' : ''), \
       NaN with lines linestyle 34 title (has_unstable ? 'stability is lost' : ''), \
       NaN with points pointtype 5 pointsize 2 * mark_scale linecolor rgb '#DDDDDD' \
           title (has_gaps ? 'no value' : ''), \
       NaN with lines linecolor rgb 'white' \
           title (has_infinite ? 'infinite: colour at the end' : ''), \
       NaN with lines linecolor rgb 'white' \
           title (clipped > 0 ? sprintf('%d values beyond the colours', clipped) : '')
  unset label 1
}
unset multiplot
unset output
