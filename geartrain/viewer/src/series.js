// made by docs/make_palette.py from geartrain/scene/palette.py
export const SERIES = ["#0072b2", "#a05a00", "#bb2288", "#227755", "#440088", "#772200", "#0000ee", "#dd2266", "#005544", "#442244"];
