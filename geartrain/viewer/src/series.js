// made by docs/scripts/make_palette.py from geartrain/scene/palette.py
export const SERIES = ["#0072b2", "#a05a00", "#bb2288", "#227755", "#440088", "#772200", "#0000ee", "#dd2266", "#005544", "#442244"];
export const FAULT = "#b3261e";
export const QUIET = "#655f52";
export const LINE = "#c9c3b4";
