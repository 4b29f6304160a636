/* Light that is drawn: spheres and rectangles that emit, and the image of an environment. */
#ifndef TOOLS_RENDER_LIGHT_H
#define TOOLS_RENDER_LIGHT_H

#include "render/scene.h"

/* Lists the lights of a scene and sums up its environment. 0 if there is no memory, or there are more than
 * SCENE_LIGHTS_MAX lights. */
int lights_make(scene *s);

typedef struct light_sample {
    vec3 direction;  /* towards the light, unit */
    double distance; /* infinite: the environment */
    double density;  /* per steradian */
    float radiance[3];
} light_sample;

/* Whether there is light to draw. */
int lights_any(const scene *s);

/* Draws light from a place, by three uniform numbers in [0, 1). 0: the place does not see what was drawn. */
int lights_draw(const scene *s, vec3 place, const double u[3], light_sample *sample);

/* The density with which lights_draw finds, from a place, what a ray has met: a shape, or (NULL) the environment. */
double lights_density(const scene *s, vec3 place, vec3 direction, const hit *h);

/* The light that comes from far away. */
void environment_radiance(const environment *e, vec3 direction, float rgb[3]);

#endif
