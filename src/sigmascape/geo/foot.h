#pragma once

namespace sigmascape::geo {

/// The international foot, and the foot of old American surveys, in metres.
inline constexpr double foot_m = 0.3048, us_survey_foot_m = 1200.0 / 3937.0;

}  // namespace sigmascape::geo
