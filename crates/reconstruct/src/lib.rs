//! Curves from ribbons of orientation sensors, and surfaces whose given boundary curves are geodesics
