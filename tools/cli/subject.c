#include "cli/subject.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"

/* ---- distributions ------------------------------------------------------------------------------- */

enum { BYTES_MAX = 1 << 29, LENGTH_MAX = 4096 };

static const char family_end[] = ".vndfs";

int is_family_file(const char *name)
{
    size_t length = strlen(name), end = sizeof family_end - 1;
    return length > end && strcmp(name + length - end, family_end) == 0;
}

/* The parameter's text behind FILE.vndfs@, or NULL. */
static const char *family_parameter(const char *name)
{
    const char *at = strrchr(name, '@');
    size_t end = sizeof family_end - 1;
    return at && at > name + end && memcmp(at - end, family_end, end) == 0 ? at + 1 : NULL;
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
    if (!families && (is_family_file(name) || family_parameter(name)))
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

int sees_nothing(const vndf_surface *surface, vndf_vec3 w)
{
    return w.z < 0 && vndf_projected_area(surface, w) < 1e-25f;
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

/* ---- the surface --------------------------------------------------------------------------------- */

/* --alpha or --matrix, and --mean, of ggx. 1, or 0 after a complaint. */
static int read_map(const arguments *given, vndf_affine *map)
{
    const char *command = given->command, *alpha = option_value(given, "--alpha");
    const char *matrix = option_value(given, "--matrix"), *mean = option_value(given, "--mean");
    double m[4], shift[2] = {0, 0};
    vndf_surface plain;
    if (alpha && matrix)
        return complain(command, "--alpha and --matrix are given; one of them is possible"), 0;
    if (!roughness_from(command, alpha, &plain) ||
        (matrix && !parse_numbers(command, "--matrix", matrix, -widest, widest, 4, 4, m)) ||
        (mean && !parse_numbers(command, "--mean", mean, -1e6, 1e6, 2, 2, shift)))
        return 0;
    *map = (vndf_affine){vndf_ggx(), plain.alpha_x, 0, 0, plain.alpha_y, (float)shift[0], (float)shift[1]};
    if (!matrix)
        return 1;
    map->xx = (float)m[0];
    map->xy = (float)m[1];
    map->yx = (float)m[2];
    map->yy = (float)m[3];
    const vndf_mixture alone = {1, {{*map, 1}}}; /* which has no view if it is singular */
    if (vndf_mixture_view_from(&alone, (vndf_vec3){0, 0, 1}).count != 1)
        return complain(
                   command,
                   "--matrix '%s' is singular, or maps slopes by less than 1e-18 or more than 1e18 times their length",
                   matrix),
               0;
    return 1;
}

/* FILE.vndfs@P; `parameter` is the text of P in it. 1, or 0 after a complaint. */
static int family_surface(chosen_surface *chosen, const char *command, const char *name, const char *parameter,
                          const vndf_affine *map)
{
    char path[LENGTH_MAX];
    double p;
    snprintf(path, sizeof path, "%.*s", (int)(parameter - name) - 1, name);
    if (!distribution_open(&chosen->of, command, path, 1) ||
        !parse_numbers(command, "the parameter", parameter, -1e30, 1e30, 1, 1, &p))
        return 0;
    vndf_family_facts facts = vndf_family_info(chosen->of.family);
    if (!((float)p >= facts.low && (float)p <= facts.high))
        return complain(command, "the parameter '%s' is not in the range of the family, from %.7g to %.7g",
                        parameter, (double)facts.low, (double)facts.high),
               0;
    vndf_family_at(chosen->of.family, (float)p, map, &chosen->mixture);
    return 1;
}

int surface_open(chosen_surface *chosen, const arguments *given)
{
    const char *command = given->command, *name = given->positional.item[0];
    const char *parameter = family_parameter(name);
    double theta = 0, phi = 0;
    vndf_affine map;
    *chosen = (chosen_surface){.mixture = {.count = 0}};
    if (!option_value(given, "--theta"))
        return complain(command,
                        "--theta is missing: the angle from the normal to the incident direction, 0 to 180"),
               0;
    if (!option_number(given, "--theta", 0, 180, &theta) || !option_number(given, "--phi", -360, 360, &phi) ||
        !read_map(given, &map))
        return 0;
    chosen->wi = direction_from(theta, phi);
    if (is_family_file(name))
        return complain(command, "'%s' is a family; say at which parameter, as in %s@2.5", name, name), 0;
    if (!(parameter ? family_surface(chosen, command, name, parameter, &map)
                    : distribution_open(&chosen->of, command, name, 0))) {
        distribution_close(&chosen->of);
        return 0;
    }
    if (!parameter) {
        map.distribution = chosen->of.distribution;
        chosen->mixture = (vndf_mixture){1, {{map, 1}}};
    }
    return 1;
}
