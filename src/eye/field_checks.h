// Limits of what varies over the field.
#pragma once

#include "aureole/image/view.h"

namespace aureole::eye {

// Throws InvalidArgument that names `what` unless low <= value <= high.
void require_deg(const char* what, double value, double low, double high);
// Throws InvalidArgument for a view that is wider or higher than 160 deg.
void check_field_of(const View& view);

}  // namespace aureole::eye
