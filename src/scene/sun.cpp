#include "scene/builders.h"
namespace aureole::scene {
Scene make_sun(const SceneOptions&, const View& view) {
    return {Image(view.width, view.height, 3), view, 1, 1};
}
}  // namespace aureole::scene
