// Where to look up a prefiltered environment. The same as aureole/ibl/dominant_direction.h, which
// explains it; unit vectors, alpha = roughness^2. Results are not of unit length: texture lookups
// of cube maps do not mind.
#ifndef AUREOLE_IBL_DOMINANT_DIRECTION_GLSL
#define AUREOLE_IBL_DOMINANT_DIRECTION_GLSL

vec3 aureole_specular_dominant_direction(vec3 normal, vec3 reflection, float alpha) {
    float smoothness = clamp(1.0 - alpha, 0.0, 1.0);
    return mix(normal, reflection, smoothness * (sqrt(smoothness) + alpha));
}

vec3 aureole_diffuse_dominant_direction(vec3 normal, vec3 view, float alpha) {
    float n_dot_v = max(dot(normal, view), 0.0);
    float towards_view = n_dot_v * (1.02341 * alpha - 1.51174) + (0.755868 - 0.511705 * alpha);
    return mix(normal, view, clamp(towards_view * alpha, 0.0, 1.0));
}

#endif
