// One lens in four formats, for tests: the Cooke triplet of data/lenses/cooke-triplet.toml, with
// catalogue glasses, and its stop on the rear face of the flint where the format can say so.
#pragma once

#include <string_view>

namespace aureole::lens {

inline constexpr std::string_view kTripletToml = R"(name = "Triplet"
f_number = 5.0
field_deg = 40.0

[[surface]]
radius_mm = 22.0136
thickness_mm = 3.259
glass = "N-SK16"
semi_aperture_mm = 9.5

[[surface]]
radius_mm = -435.76
thickness_mm = 6.0076
semi_aperture_mm = 9.5

[[surface]]
radius_mm = -22.2133
thickness_mm = 0.99997
glass = "F2"
semi_aperture_mm = 5.0

[[surface]]
radius_mm = 20.2919
thickness_mm = 0.0
semi_aperture_mm = 5.0

[[surface]]
thickness_mm = 4.7504
semi_aperture_mm = 5.0
stop = true

[[surface]]
radius_mm = 79.6837
thickness_mm = 2.9521
glass = "N-SK16"
semi_aperture_mm = 7.5

[[surface]]
radius_mm = -18.3953
thickness_mm = 42.208
conic = -0.125
asphere = [0.0, 2e-8]
semi_aperture_mm = 7.5
)";

// In centimetres, curvatures with 16 digits; one glass as a model.
inline constexpr std::string_view kTripletZmx = R"(VERS 130404
MODE SEQ
NAME Triplet
UNIT CM X W X CM MR CPMM
FNUM 5 0
FTYP 0 0 3 3 0 0 0
YFLN 0 14 20 0
WAVM 1 5.875618E-1 1
SURF 0
  TYPE STANDARD
  CURV 0.0 0 0 0 0 ""
  DISZ INFINITY
  DIAM 0 0 0 0 1 ""
SURF 1
  TYPE STANDARD
  CURV 0.454264636406585 0 0 0 0 ""
  COAT AR
  DISZ 0.3259
  GLAS SK16 0 0 1.5 4.0E+1 0 0 0 0 0 0
  DIAM 0.95 1 0 0 1 ""
SURF 2
  TYPE STANDARD
  CURV -2.2948411969891683E-002 0 0 0 0 ""
  DISZ 0.60076
  DIAM 0.95 1 0 0 1 ""
SURF 3
  TYPE STANDARD
  CURV -0.4501807475701494
  DISZ 9.9997E-2
  GLAS F2 0 0 1.5 4.0E+1
  DIAM 0.5 1
SURF 4
  STOP
  TYPE STANDARD
  CURV 0.4928074749037794
  DISZ 0.47504
  DIAM 0.5 1
SURF 5
  TYPE STANDARD
  CURV 0.12549618052374575
  DISZ 0.29521
  GLAS N-SK16 0 0
  DIAM 0.75 1
SURF 6
  TYPE EVENASPH
  CURV -0.5436171195903302
  PARM 1 0
  PARM 2 0
  PARM 3 2E-3
  PARM 4 0
  DISZ 4.2208
  CONI -0.125
  DIAM 0.75 1
SURF 7
  TYPE STANDARD
  CURV 0.0
  DISZ 0
  DIAM 1.8
)";

inline constexpr std::string_view kTripletSeq = R"(RDM;LEN       "VERSION: 11.2"
TITLE 'Triplet'                    ! a comment; with a semicolon
FNO   5.0
DIM   M
WL    656.3 587.6 &
      486.1
REF   2
YAN   0.0 14.0 20.0
SO    0.0 0.1e14
S     22.0136 3.259 NSK16_SCHOTT
  CIR 9.5; CCY 0
S     -435.76 6.0076
  CIR 9.5
S     -22.2133 0.99997 F2_SCHOTT
  CIR 5.0
S     20.2919 4.7504
  CIR EDG 5.5
  CIR 5.0
  STO
S     79.6837 2.0
  GLA 'N-SK16'
S     -18.3953 42.208
  ASP
  K -0.125
  A 0.0; B 2.0e-8; C 0.0
CIR S5 7.5
CIR S6 7.5
THI S5 2.9521
SI    0.0 0.1
GO
)";

// Without dispersion and asphere, which the format does not know.
inline constexpr std::string_view kTripletDat = R"(# Triplet
# radius thickness index diameter
22.0136   3.259    1.62041  19.0
-435.76   6.0076   1        19.0
-22.2133  0.99997  1.62004  10.0
20.2919   0        1        10.0
0         4.7504   0        10.0   # the stop
79.6837   2.9521   1.62041  15.0
-18.3953  42.208   1        15.0
)";

}  // namespace aureole::lens
