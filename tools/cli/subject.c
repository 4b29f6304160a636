#include "cli/subject.h"

#include <math.h>
#include <string.h>

#include "cli/output.h"

int distribution_open(chosen_distribution *chosen, const char *command, const char *name)
{
    vndf_error error = {VNDF_OK, ""};
    chosen->owned = NULL;
    chosen->distribution = NULL;
    if (strcmp(name, "ggx") == 0)
        chosen->distribution = vndf_ggx();
    else if (strcmp(name, "beckmann") == 0)
        chosen->distribution = vndf_beckmann();
    else if (is_family_file(name) || family_parameter(name)) {
        complain(command,
                 "'%s' is a family; a single table is needed (eval and sample take FILE.vndfs@P, info FILE.vndfs)",
                 name);
        return 0;
    } else if (!input_named(command, name))
        return 0;
    else
        chosen->distribution = chosen->owned = vndf_load(name, &error);
    if (!chosen->distribution)
        complain(command, "%s", error.message);
    return chosen->distribution != NULL;
}

void distribution_close(chosen_distribution *chosen)
{
    vndf_free(chosen->owned);
}

static const char family_end[] = ".vndfs";

int is_family_file(const char *name)
{
    size_t length = strlen(name), end = sizeof family_end - 1;
    return length > end && strcmp(name + length - end, family_end) == 0;
}

const char *family_parameter(const char *name)
{
    const char *at = strrchr(name, '@');
    size_t end = sizeof family_end - 1;
    return at && at > name + end && memcmp(at - end, family_end, end) == 0 ? at + 1 : NULL;
}

vndf_family *family_open(const char *command, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    if (!input_named(command, path))
        return NULL;
    vndf_family *family = vndf_family_load(path, &error);
    if (!family)
        complain(command, "%s", error.message);
    return family;
}

/* Reduced to a quarter turn first, so that cos(90 degrees) is 0 and not 6e-17: a direction on the
 * horizon is meant to be on it. */
static double sine_of_degrees(double degrees)
{
    const double radian = acos(-1.0) / 180;
    double turn = fmod(degrees, 360);
    if (turn < 0)
        turn += 360;
    if (turn >= 180)
        return -sine_of_degrees(turn - 180);
    return turn <= 90 ? (turn > 45 ? cos((90 - turn) * radian) : sin(turn * radian)) : sine_of_degrees(180 - turn);
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

int roughness_from(const char *command, const char *text, vndf_surface *surface)
{
    double alpha[2] = {1, 1};
    size_t count = text ? parse_numbers(command, "--alpha", text, 1e-18, 1e18, 1, 2, alpha) : 2;
    if (count == 1)
        alpha[1] = alpha[0];
    surface->alpha_x = (float)alpha[0];
    surface->alpha_y = (float)alpha[1];
    return count != 0;
}
