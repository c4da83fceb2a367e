#include "eye/before_pupil.h"

#include <cmath>

#include "aureole/base/units.h"

namespace aureole::eye {

Oblique oblique(const Eye& eye, const FieldPosition& field) {
    check(field);
    const double x = std::tan(rad_from_deg(field.x_deg));
    const double y = std::tan(rad_from_deg(field.y_deg));
    const double r = std::hypot(x, y);
    if (r == 0) return {};
    const double distance_mm = eye.anatomy.lashes.distance_mm;
    return {-distance_mm * x, -distance_mm * y, x / r, y / r, 1 - 1 / std::hypot(1, r)};
}

wave::Point foreshortened(wave::Point point, const Oblique& view) {
    const double along = point.x_mm * view.along_x + point.y_mm * view.along_y;
    point.x_mm -= view.shortening * along * view.along_x;
    point.y_mm -= view.shortening * along * view.along_y;
    return point;
}

wave::Shape seen(wave::Shape shape, Layer layer, const Oblique& view) {
    if (view.shortening == 0) return shape;
    const bool shifted = layer == Layer::kBeforePupil;
    for (auto& outline : shape.outlines) {
        for (wave::Point& point : outline) {
            if (shifted) {
                point.x_mm += view.shift_x_mm;
                point.y_mm += view.shift_y_mm;
            }
            point = foreshortened(point, view);
        }
    }
    return shape;
}

}  // namespace aureole::eye
