#include "cli/subject.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"

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
        return denied(command,
                      "'%s' is a family; a single table is needed (sample takes FILE.vndfs@P, info FILE.vndfs)",
                      name);
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

enum { NDF, SLOPE, CSV, FAMILY };

const char *const source_kinds[] = {"--ndf", "--slope", "--csv", "--family", NULL};

vndf_source *source_from_csv(const char *command, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    size_t size;
    char *text = input_read(command, path, VNDF_LIMIT_CSV_BYTES, &size);
    vndf_source *source = text ? vndf_source_csv_text(input_name(path), text, size, &error) : NULL;
    if (text && !source)
        complain(command, "%s", error.message);
    free(text);
    return source;
}

/* Of a formula, with the numbers "a=0.3" of --set; the library judges their names itself. */
static vndf_source *source_from_formula(const arguments *given, const char *kind, vndf_error *error)
{
    const words set = option_values(given, "--set");
    vndf_parameter parameters[WORDS_MAX];
    char names[WORDS_MAX][VNDF_LIMIT_PARAMETER_NAME + 1];
    for (size_t i = 0; i < set.count; i++) {
        const size_t length = strcspn(set.item[i], "=");
        if (length == 0 || length >= sizeof names[i] || !set.item[i][length])
            return complain(given->command, "--set '%s' is not NAME=NUMBER", set.item[i]), NULL;
        snprintf(names[i], sizeof names[i], "%.*s", (int)length, set.item[i]);
        parameters[i].name = names[i];
        if (!parse_numbers(given->command, "--set", set.item[i] + length + 1, -1e300, 1e300, 1, 1,
                           &parameters[i].value))
            return NULL;
    }
    return (kind == source_kinds[NDF] ? vndf_source_ndf_expression : vndf_source_slope_expression)(
        option_value(given, kind), parameters, set.count, error);
}

/* What the program has beside the library for a name that is not known. */
static const char *more_of(const char *message)
{
    return strstr(message, "did you mean")   ? ""
           : strstr(message, "unknown name") ? "; a parameter of your own has its value by --set NAME=X"
           : strstr(message, "unknown family") || strstr(message, "unknown material")
               ? "; `vndf build --list` has them and all materials"
               : "";
}

vndf_source *source_from_words(const arguments *given, const char *otherwise)
{
    const char *command = given->command, *kind = option_among(given, source_kinds);
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source;
    if ((kind || !otherwise) && !option_alone(given, source_kinds))
        return NULL;
    const int is_formula = kind == source_kinds[NDF] || kind == source_kinds[SLOPE];
    if (option_value(given, "--set") && !is_formula)
        return complain(command, "--set is for --ndf and --slope; the parameters of a family follow its name"),
               NULL;
    if (kind == source_kinds[CSV])
        return source_from_csv(command, option_value(given, kind));
    if (is_formula)
        source = source_from_formula(given, kind, &error);
    else
        source = vndf_source_family(kind ? option_value(given, kind) : otherwise, &error);
    if (!source && error.status != VNDF_OK)
        complain(command, "%s: %s%s", kind ? kind : "--family", error.message, more_of(error.message));
    return source;
}

const char *source_name(const vndf_source *source)
{
    static const char family[] = "--family ";
    const char *name = vndf_source_description(source);
    return strncmp(name, family, sizeof family - 1) == 0 ? name + sizeof family - 1 : name;
}

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
    *surface = vndf_rough(NULL, (float)alpha[0], (float)alpha[count == 2]);
    return count != 0;
}
