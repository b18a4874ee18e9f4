# One figure of curves: stable parts solid, unstable parts dashed, special points marked. The program puts this
# file into the script once for each format.
#
# Besides the values listed in style.gp the program has set:
#   curve_parts   names of data blocks with lines, "stable_1 stable_2 unknown_1 driven_1 unstable_1 ..."; the
#                 number is that of the curve; a block holds x y, empty lines between separate parts
#   curve_hues    one number per curve: 0, its colour tells its stability; n, it is the n-th branch of a
#                 diagram and has the n-th colour, its dashes tell its stability
#   curve_colors  one per curve: the colour of the value of its run, or 'by_hue'
#   has_mixed     1: the block mixed holds stretches where lines of different stability lie on each other
#   of_points     1: lines are critical points over a parameter, 0: equilibria
#   first_parts   those of them that stand for the others of their kind in the key: kinds that are seen
#   mixed_in_key  1: of that block something is seen
#   quantities    number of quantities over the same x, with quantity_name[n]; the n-th has the n-th colour. Of one: 0
#   x_log, y_log  1: logarithmic; x_ticks, y_ticks: lists of ticks where powers of ten are too few, otherwise empty
#   insets        number of enlarged parts; inset_x_low, inset_left, ... are lists of as many numbers, the rooms
#                 for numbers in parts of the inset; inset_x_ticks_1, inset_y_ticks_1, ... are lists of ticks
#   has_bar       1: palette_text, bar_title, bar_low, bar_high say what the colours of curves mean
#   regions       number of shaded parts, with region_name[n]; block region_<n> holds outlines; region_wanted has for
#                 each 1, nothing unwanted happens there, or 0, it happens whatever is done
#   point_codes   "start LP SA ...": codes that occur; block point_<code> holds x y
#   key_codes     those of them that are seen
# Labels and their leader lines are set already: they hang on points of the axes.

part_style(part) = part[1:6] eq 'stable' ? 1 : part[1:6] eq 'driven' ? 6 : part[1:6] eq 'unknow' ? 8 : 2
part_kind(part) = of_points ? point_kind(part) : \
                  part[1:6] eq 'stable' ? 'stable' : part[1:6] eq 'unknow' ? 'stability not known' : \
                  part[1:6] eq 'driven' ? 'unstable under dead load' : 'unstable'
point_kind(part) = part[1:6] eq 'stable' ? 'no other mode unstable' : \
                   part[1:6] eq 'unknow' ? 'other modes not counted' : \
                   part[1:6] eq 'driven' ? 'another unstable under dead load' : 'another mode unstable'
part_hue(part) = part eq 'nothing' ? 0 : int(word(curve_hues, int(part[strstrt(part, '_') + 1:*])))
own_color(part) = part eq 'nothing' ? 'by_hue' : word(curve_colors, int(part[strstrt(part, '_') + 1:*]))
part_color(part) = own_color(part) ne 'by_hue' ? own_color(part) : part_hue(part) > 0 \
    ? word(branch_colors, (part_hue(part) - 1) % words(branch_colors) + 1) \
    : part[1:6] eq 'stable' ? stable_color : part[1:6] eq 'driven' ? driven_color : \
    part[1:6] eq 'unknow' ? ink : unstable_color
# Lines of a diagram or a sweep stand in the key in ink: their colours tell branches or values.
is_first(part) = strstrt(' '.first_parts.' ', ' '.part.' ') > 0
key_color(part) = part_hue(part) > 0 || own_color(part) ne 'by_hue' ? ink : part_color(part)

set lmargin at screen frame_left
set rmargin at screen frame_right
set bmargin at screen frame_bottom
set tmargin at screen frame_top
if (x_log) { set logscale x } else { unset logscale x }
if (y_log) { set logscale y } else { unset logscale y }
set xtics autofreq
set ytics autofreq
if (words(x_ticks) > 0) { set xtics (word(x_ticks, 1) real(word(x_ticks, 1))) }
if (words(y_ticks) > 0) { set ytics (word(y_ticks, 1) real(word(y_ticks, 1))) }
do for [tick in x_ticks] { set xtics add (tick real(tick)) }
do for [tick in y_ticks] { set ytics add (tick real(tick)) }
set xrange [x_low:x_high]
set yrange [y_low:y_high]
unset xzeroaxis
unset yzeroaxis
if (x_low < 0 && x_high > 0) set yzeroaxis linestyle 5
if (y_low < 0 && y_high > 0) set xzeroaxis linestyle 5

set title figure_title @figure_title_mode font title_font textcolor rgb ink offset 0, 2.7
set xlabel x_title @x_title_mode font sized(fitted(x_title, figure_font_size, 0.9 * figure_width)) textcolor rgb ink offset 0, -0.4
set ylabel y_title @y_title_mode font sized(fitted(y_title, figure_font_size, 0.9 * figure_height)) textcolor rgb ink offset -0.6, 0
# Up to three entries in a row above the frame; three rows stand closer.
key_rows = (words(first_parts) + words(key_codes) + mixed_in_key + quantities + regions + 2) / 3
set key at screen (frame_left + frame_right) / 2, \
    screen frame_top + 4.5 * figure_font_size / figure_height top center \
    vertical maxrows key_rows Left reverse noenhanced samplen 3 \
    spacing (key_rows > 2 ? 0.9 : 1.25) font key_font textcolor rgb ink


# Blocks that are not there are never drawn, but gnuplot looks for their names.
mixed_block = has_mixed ? '$mixed' : '$'.word(curve_parts, 1)
bar_block = has_bar ? '$bar' : '$'.word(curve_parts, 1)
region_block(k) = regions > 0 ? '$region_'.k : '$'.word(curve_parts, 1)
region_tint(k) = word(region_wanted, k) eq '1' ? wanted_tint : unwanted_tint
bar_value = has_bar ? bar_low : 0
if (!has_bar) { palette_text = '0 "black", 1 "white"'; set cbrange [0:1] }
if (has_bar) {
  set palette defined (@palette_text)
  set cbrange [bar_low:bar_high]
  # At the edge of the picture, clear of the numbers however long they are.
  unset cblabel
  set label bar_title at screen 1 - 0.9 * figure_font_size / figure_width, \
      screen (frame_bottom + frame_top) / 2 center rotate by 90 noenhanced font base_font textcolor rgb ink
  set colorbox user origin frame_right + 25.0 / figure_width, frame_bottom \
      size 20.0 / figure_width, frame_top - frame_bottom
}

figure_terminal = terminal_of(figure_format)
set terminal @figure_terminal
set output output_of(figure_format)
if (insets > 0) { set multiplot }
plot for [k = 1:regions] region_block(k) with filledcurves closed fillcolor rgb region_tint(k) \
         fillstyle solid noborder title region_name[k], \
     for [k = 1:has_mixed] mixed_block with lines linestyle 7 \
         title (mixed_in_key ? 'with a less stable one on it' : ''), \
     for [part in curve_parts] '$'.part with lines linestyle part_style(part) \
         linecolor rgb part_color(part) notitle, \
     for [part in curve_parts] 1/0 with lines linestyle part_style(part) \
         linecolor rgb key_color(part) title (is_first(part) ? part_kind(part) : ''), \
     for [n = 1:quantities] 1/0 with lines linewidth 3.2 linecolor rgb \
         word(branch_colors, (n - 1) % words(branch_colors) + 1) title quantity_name[n], \
     for [code in point_codes] '$point_'.code with points linestyle point_style(code) \
         title (strstrt(' '.key_codes.' ', ' '.code.' ') > 0 ? point_name(code) : ''), \
     for [k = 1:has_bar] bar_block using 1:2:(bar_value) with dots palette notitle
# A minus as gnuplot writes it at the axes.
tick_text(t) = (figure_format ne 'tikz' && substr(t, 1, 1) eq '-') ? "−" . substr(t, 2, strlen(t)) : t
do for [k = 1:insets] {
  unset title
  unset xlabel
  unset ylabel
  unset key
  unset label
  unset arrow
  unset colorbox
  # White beneath the numbers too.
  set object 1 rectangle from graph -real(word(inset_left_room, k)), \
      graph -real(word(inset_bottom_room, k)) to graph 1, graph 1 noclip behind fillcolor rgb 'white' \
      fillstyle solid noborder
  set lmargin at screen real(word(inset_left, k))
  set rmargin at screen real(word(inset_right, k))
  set bmargin at screen real(word(inset_bottom, k))
  set tmargin at screen real(word(inset_top, k))
  set xrange [real(word(inset_x_low, k)):real(word(inset_x_high, k))]
  set yrange [real(word(inset_y_low, k)):real(word(inset_y_high, k))]
  set border 15
  inset_x_ticks = value(sprintf('inset_x_ticks_%d', k))
  inset_y_ticks = value(sprintf('inset_y_ticks_%d', k))
  set xtics (tick_text(word(inset_x_ticks, 1)) real(word(inset_x_ticks, 1))) font key_font
  set ytics (tick_text(word(inset_y_ticks, 1)) real(word(inset_y_ticks, 1))) font key_font
  do for [tick in inset_x_ticks] { set xtics add (tick_text(tick) real(tick)) }
  do for [tick in inset_y_ticks] { set ytics add (tick_text(tick) real(tick)) }
  plot for [j = 1:regions] region_block(j) with filledcurves closed fillcolor rgb region_tint(j) \
           fillstyle solid noborder, \
       for [j = 1:has_mixed] mixed_block with lines linestyle 7, \
       for [part in curve_parts] '$'.part with lines linestyle part_style(part) \
           linecolor rgb part_color(part), \
       for [code in point_codes] '$point_'.code with points linestyle point_style(code)
  unset object 1
  set border 3
  set xtics autofreq font base_font
  set ytics autofreq font base_font
}
if (insets > 0) { unset multiplot }
unset output
