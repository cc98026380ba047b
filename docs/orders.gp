# Plots what `pullfocus bench --table orders --data FILE` wrote (docs/measure.py does):
#   gnuplot -e "data='FILE'; out='orders.svg'" orders.gp
set terminal svg size 1000,640 background "white" font "sans-serif,13"
set output out
set multiplot layout 2,3
set logscale xy
set xlabel "budget, % of changed pixels"
set ylabel "RMSE against linear"
set xtics (5, 15, 30, 60)
set xrange [4:75]
set format y "10^{%T}"
set grid ytics
set key bottom left
do for [i=0:4] {
  set title word("star slow-pull fast-pull light-change reversed-pull", i + 1)
  plot data index i using 1:($2 > 0 ? $2 : 1/0) with linespoints lw 2 pt 7 title "gain", \
       data index i using 1:($3 > 0 ? $3 : 1/0) with linespoints lw 2 pt 5 title "fearing", \
       data index i using 1:($4 > 0 ? $4 : 1/0) with linespoints lw 2 pt 9 title "random"
}
unset multiplot
