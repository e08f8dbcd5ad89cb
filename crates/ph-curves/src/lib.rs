//! Dual Bézier, Pythagorean-hodograph and Tschirnhausen curves with exact offsets, ovals, cams and frames
