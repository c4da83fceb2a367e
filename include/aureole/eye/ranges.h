// What an eye may be asked about: how bright, and when.
#pragma once

namespace aureole::eye {

// cd/m2. Anything darker is taken as this: no pupil opens any wider. (A starless sky has 1e-4.)
inline constexpr double kDarknessCdM2 = 1e-6;
// cd/m2. Anything brighter is refused; the disc of the sun has 1.6e9.
inline constexpr double kBrightestCdM2 = 1e12;
// s. Moments lie within thirty years of 0 on either side, where a double still tells a tenth of a
// microsecond. Curves beyond are refused; functions of time that cannot throw answer for the
// nearest moment within.
inline constexpr double kFarthestTimeS = 1e9;

}  // namespace aureole::eye
