#include "cli/subject.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"

/* ---- distributions ------------------------------------------------------------------------------- */

enum { BYTES_MAX = 1 << 29 };

int is_family_file(const char *name)
{
    size_t length = strlen(name);
    return length > 6 && strcmp(name + length - 6, ".vndfs") == 0;
}

int distribution_open(chosen_distribution *chosen, const char *command, const char *name, int families)
{
    static const char *const closed_forms[] = {"ggx", "beckmann"};
    vndf_error error = {VNDF_OK, ""};
    size_t size;
    *chosen = (chosen_distribution){.distribution = strcmp(name, "ggx") == 0        ? vndf_ggx()
                                                    : strcmp(name, "beckmann") == 0 ? vndf_beckmann()
                                                                                    : NULL};
    if (chosen->distribution)
        return 1;
    if (!families && (is_family_file(name) || strstr(name, ".vndfs@")))
        return complain(command,
                        "'%s' is a family; a single table is needed (sample takes FILE.vndfs@P, info FILE.vndfs)",
                        name),
               0;
    char *bytes = input_read(command, name, BYTES_MAX, &size);
    const char *hint = bytes ? NULL : nearest_word(name, closed_forms, 2);
    if (hint)
        complain(command, "did you mean '%s'?", hint);
    if (bytes && is_family_file(name))
        chosen->family = vndf_family_load_memory(bytes, size, &error);
    else if (bytes)
        chosen->distribution = chosen->owned = vndf_load_memory(bytes, size, &error);
    if (error.status != VNDF_OK)
        complain(command, "%s: %s%s", input_name(name), error.message,
                 strstr(error.message, "not a vndf table") ? "; `vndf build` makes tables" : "");
    free(bytes);
    return chosen->family || chosen->owned;
}

void distribution_close(chosen_distribution *chosen)
{
    vndf_free(chosen->owned);
    vndf_family_free(chosen->family);
}

/* ---- directions and roughness -------------------------------------------------------------------- */

/* By an angle of at most 45 degrees, so that cos(90 degrees) is 0 and not 6e-17: a direction on the horizon is meant to
 * be on it. */
static double sine_of_degrees(double degrees)
{
    const double radian = acos(-1.0) / 180, turn = remainder(degrees, 360);
    const double acute = fmin(fabs(turn), 180 - fabs(turn));
    return copysign(acute > 45 ? cos((90 - acute) * radian) : sin(acute * radian), turn);
}

vndf_vec3 direction_from(double theta, double phi)
{
    double sine = sine_of_degrees(theta), cosine = sine_of_degrees(theta + 90);
    vndf_vec3 direction = {(float)(sine * sine_of_degrees(phi + 90)), (float)(sine * sine_of_degrees(phi)),
                           (float)cosine};
    return direction;
}

static const double narrowest = 1e-18, widest = 1e18; /* what the library takes for roughness */

int roughness_from(const char *command, const char *text, vndf_surface *surface)
{
    double alpha[2] = {1, 1};
    size_t count = text ? parse_numbers(command, "--alpha", text, narrowest, widest, 1, 2, alpha) : 2;
    surface->alpha_x = (float)alpha[0];
    surface->alpha_y = (float)alpha[count == 2];
    return count != 0;
}
