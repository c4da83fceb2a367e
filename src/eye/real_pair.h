// Two real planes in one complex transform.
#pragma once

#include "aureole/wave/aperture.h"

namespace aureole::eye {

// The transform F of a + i b, a and b real, holds both: F{a} = (F(k) + F*(-k)) / 2 and
// F{b} = (F(k) - F*(-k)) / 2i. Replaces re by |F{a}| and im by |F{b}|, both symmetric under a half
// turn. The sum of their squares is |F|^2 averaged over k and -k.
void separate_amplitudes(wave::Field& field);

}  // namespace aureole::eye
