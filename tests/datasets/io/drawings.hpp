#pragma once

#include <opencv2/core.hpp>

#include "datasets/sketch.hpp"

namespace sketchloc::testing {

/// 255 on the strokes of a small floor plan with rooms and doors: what a person drew. The picture
/// is about 300 x 200 px times `zoom`, strokes are 3 px times `zoom` wide.
cv::Mat1b drawn_strokes(int zoom = 1);

/// 255 in the rooms of a floor plan, painted as one area.
cv::Mat1b painted_rooms();

/// One grey level where the mask is set, another elsewhere, and Gaussian noise.
cv::Mat1b picture_of(const cv::Mat1b& mask, int inside, int outside, double noise = 0.0);

/// A photo of a drawing with dark ink: light from one corner, a shadow, noise, specks of dirt.
cv::Mat1b photo_of(const cv::Mat1b& strokes, bool dirt);

/// Share of the cells where the drawing and the mask agree, of those where either is set.
double overlap(const Sketch& sketch, const cv::Mat1b& mask);

}  // namespace sketchloc::testing
