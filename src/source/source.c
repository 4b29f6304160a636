/* The calls that all kinds of source have in common, and sources given by a C function: P22(r), or D(cos theta) with
 * P22(r) = D(c) c^4, c = 1/sqrt(1 + r^2). */
#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "source/source.h"
#include "source/words.h"

double vndf_source_p22(const vndf_source *source, double r)
{
    double value = 0.0;
    if (source)
        source->p22(source, &r, 1, &value);
    return value;
}

const char *vndf_source_description(const vndf_source *source)
{
    return source ? source->description : "";
}

void vndf_source_free(vndf_source *source)
{
    if (source)
        source->destroy(source);
}

/* ---- functions -------------------------------------------------------------------------------- */

enum { OPERATIONS = 8 }; /* the cost of a call, whatever it does: a guess */

typedef struct callback_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_density_function *density;
    void *user;
    int is_ndf;
} callback_source;

static void p22(const vndf_source *self, const double *r, size_t count, double *values)
{
    const callback_source *source = (const callback_source *)self;
    for (size_t i = 0; i < count; i++) {
        double c = 1 / hypot(1, r[i]), c2 = c * c;
        values[i] =
            source->is_ndf ? source->density(c, source->user) * c2 * c2 : source->density(r[i], source->user);
    }
}

static void destroy(vndf_source *self)
{
    free(self->description);
    free(self);
}

/* `vndf build` has no such option, since a shell cannot bring a function. It says what the table came from. */
static vndf_source *make(int is_ndf, vndf_density_function *density, void *user, const char *name,
                         vndf_error *error)
{
    if (!density) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the callback is NULL; a function is needed");
        return NULL;
    }
    char *description = vndf_text_pair(is_ndf ? "--ndf-callback" : "--slope-callback", name, "", error);
    callback_source *source = description ? malloc(sizeof *source) : NULL;
    if (source) {
        *source = (callback_source){
            {.p22 = p22, .destroy = destroy, .description = description, .operations = OPERATIONS},
            density,
            user,
            is_ndf};
        return &source->base;
    }
    if (description)
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a source");
    free(description);
    return NULL;
}

vndf_source *vndf_source_ndf_callback(vndf_density_function *ndf, void *user, const char *name, vndf_error *error)
{
    return make(1, ndf, user, name, error);
}

vndf_source *vndf_source_slope_callback(vndf_density_function *density, void *user, const char *name,
                                        vndf_error *error)
{
    return make(0, density, user, name, error);
}
