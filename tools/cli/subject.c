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

static vndf_distribution *load_table(const char *command, const char *name)
{
    static const char *const closed_forms[] = {"ggx", "beckmann"};
    vndf_error error = {VNDF_OK, ""};
    size_t size;
    char *bytes = input_read(command, name, BYTES_MAX, &size);
    if (!bytes && nearest_word(name, closed_forms, 2))
        complain(command, "did you mean '%s'?", nearest_word(name, closed_forms, 2));
    vndf_distribution *table = bytes ? vndf_load_memory(bytes, size, &error) : NULL;
    if (bytes && !table)
        complain(command, "%s: %s", input_name(name), error.message);
    free(bytes);
    return table;
}

int distribution_open(chosen_distribution *chosen, const char *command, const char *name)
{
    *chosen = (chosen_distribution){NULL, NULL};
    if (strcmp(name, "ggx") == 0)
        chosen->distribution = vndf_ggx();
    else if (strcmp(name, "beckmann") == 0)
        chosen->distribution = vndf_beckmann();
    else if (is_family_file(name) || family_parameter(name))
        complain(command,
                 "'%s' is a family; a single table is needed (eval and sample take FILE.vndfs@P, info FILE.vndfs)",
                 name);
    else
        chosen->distribution = chosen->owned = load_table(command, name);
    return chosen->distribution != NULL;
}

void distribution_close(chosen_distribution *chosen)
{
    vndf_free(chosen->owned);
}

vndf_family *family_open(const char *command, const char *path)
{
    vndf_error error = {VNDF_OK, ""};
    size_t size;
    char *bytes = input_read(command, path, BYTES_MAX, &size);
    vndf_family *family = bytes ? vndf_family_load_memory(bytes, size, &error) : NULL;
    if (bytes && !family)
        complain(command, "%s: %s", input_name(path), error.message);
    free(bytes);
    return family;
}

/* ---- directions and roughness -------------------------------------------------------------------- */

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

static const double narrowest = 1e-18, widest = 1e18; /* what the library takes for roughness */

int roughness_from(const char *command, const char *text, vndf_surface *surface)
{
    double alpha[2] = {1, 1};
    size_t count = text ? parse_numbers(command, "--alpha", text, narrowest, widest, 1, 2, alpha) : 2;
    surface->alpha_x = (float)alpha[0];
    surface->alpha_y = (float)alpha[count == 2];
    return count != 0;
}

/* ---- lobes of a surface -------------------------------------------------------------------------- */

/* A lobe of a table or a closed form, or the two of FILE.vndfs@P; 0 after a complaint. */
static int add_distribution(chosen_surface *chosen, const char *command, const char *name, vndf_mixture_lobe lobe,
                            int option)
{
    vndf_mixture at = {1, {lobe}};
    const char *parameter = family_parameter(name);
    double p;
    if (!parameter && is_family_file(name))
        return complain(command, "'%s' is a family; say at which parameter, as in %s@2.5", name, name), 0;
    if (chosen->mixture.count + (parameter != NULL) >= VNDF_MIXTURE_LOBES)
        return complain(command, "--lobe: these are more than %d lobes; a family counts as two",
                        VNDF_MIXTURE_LOBES),
               0;
    if (parameter) {
        char path[LENGTH_MAX];
        snprintf(path, sizeof path, "%.*s", (int)(parameter - name) - 1, name);
        vndf_family *family = family_open(command, path);
        if (!family)
            return 0;
        chosen->family[chosen->families++] = family;
        vndf_family_facts facts = vndf_family_info(family);
        if (!parse_numbers(command, "the parameter", parameter, -1e30, 1e30, 1, 1, &p))
            return 0;
        if (!((float)p >= facts.low && (float)p <= facts.high))
            return complain(command, "the parameter '%s' is not in the range of the family, from %.7g to %.7g",
                            parameter, (double)facts.low, (double)facts.high),
                   0;
        vndf_family_at(family, (float)p, &lobe.surface, &at);
    } else {
        chosen_distribution *table = &chosen->table[chosen->tables];
        if (!distribution_open(table, command, name))
            return 0;
        chosen->tables++;
        at.lobe[0].weight = 1;
        at.lobe[0].surface.distribution = table->distribution;
    }
    for (int i = 0; i < at.count; i++) {
        at.lobe[i].weight *= lobe.weight;
        chosen->option[chosen->mixture.count] = option;
        chosen->mixture.lobe[chosen->mixture.count++] = at.lobe[i];
    }
    return 1;
}

enum { KEY_TABLE, KEY_WEIGHT, KEY_ALPHA, KEY_MATRIX, KEY_MEAN, KEYS };
static const char *const key_names[KEYS + 1] = {"table", "weight", "alpha", "matrix", "mean", NULL};

typedef struct lobe_text {
    const char *command;
    char where[16]; /* "--lobe 2": opens messages */
    char text[LENGTH_MAX];
    const char *value[KEYS]; /* in text, or NULL */
} lobe_text;

/* "alpha=0.2 weight=1" into lobe->value. 1, or 0 after a complaint. */
static int split_lobe(lobe_text *lobe, const char *given)
{
    static const char blanks[] = " \t\r\n";
    char what[32];
    snprintf(what, sizeof what, "%s: the key", lobe->where);
    if (strlen(given) >= sizeof lobe->text)
        return complain(lobe->command, "%s has more than %d characters", lobe->where, LENGTH_MAX - 1), 0;
    strcpy(lobe->text, given);
    for (char *word = strtok(lobe->text, blanks); word; word = strtok(NULL, blanks)) {
        char *equals = strchr(word, '=');
        if (!equals)
            return complain(lobe->command, "%s: '%.40s' is not KEY=VALUE", lobe->where, word), 0;
        *equals = '\0';
        int key = word_among(lobe->command, what, word, key_names);
        if (key < 0)
            return 0;
        if (lobe->value[key])
            return complain(lobe->command, "%s: %s is given twice", lobe->where, word), 0;
        lobe->value[key] = equals + 1;
    }
    if (!lobe->value[KEY_TABLE])
        return complain(lobe->command, "%s: table=" SURFACE_POSITIONAL " is missing", lobe->where), 0;
    if (lobe->value[KEY_ALPHA] && lobe->value[KEY_MATRIX])
        return complain(lobe->command, "%s has both alpha and matrix; one of them is possible", lobe->where), 0;
    return 1;
}

/* As many numbers as `least` to `most`; an absent key leaves them as they are. 1, or 0 after a complaint. */
static int read_key(const lobe_text *lobe, int key, double low, double high, size_t least, size_t most,
                    double *numbers)
{
    char what[32];
    if (!lobe->value[key])
        return 1;
    snprintf(what, sizeof what, "%s: %s", lobe->where, key_names[key]);
    size_t count = parse_numbers(lobe->command, what, lobe->value[key], low, high, least, most, numbers);
    if (count == 1 && most == 2)
        numbers[1] = numbers[0];
    return count != 0;
}

static int read_numbers(const lobe_text *lobe, vndf_mixture_lobe *to)
{
    double weight = 1, alpha[2] = {1, 1}, matrix[4], mean[2] = {0, 0};
    if (!read_key(lobe, KEY_WEIGHT, 0, 1e30, 1, 1, &weight) ||
        !read_key(lobe, KEY_ALPHA, narrowest, widest, 1, 2, alpha) ||
        !read_key(lobe, KEY_MATRIX, -widest, widest, 4, 4, matrix) ||
        !read_key(lobe, KEY_MEAN, -1e6, 1e6, 2, 2, mean))
        return 0;
    if (!lobe->value[KEY_MATRIX]) {
        matrix[0] = alpha[0];
        matrix[1] = matrix[2] = 0;
        matrix[3] = alpha[1];
    }
    to->weight = (float)weight;
    to->surface =
        (vndf_affine){NULL,           (float)matrix[0], (float)matrix[1], (float)matrix[2], (float)matrix[3],
                      (float)mean[0], (float)mean[1]};
    return 1;
}

/* A matrix that is singular or out of the range of floats has no view. */
static int is_valid(const vndf_affine *surface)
{
    vndf_mixture alone = {1, {{*surface, 1}}};
    vndf_vec3 up = {0, 0, 1};
    return vndf_mixture_view_from(&alone, up).count == 1;
}

static int add_lobe(chosen_surface *chosen, const char *command, const char *given, int option)
{
    lobe_text lobe = {.command = command};
    vndf_mixture_lobe next;
    snprintf(lobe.where, sizeof lobe.where, "--lobe %d", option + 1);
    if (!split_lobe(&lobe, given) || !read_numbers(&lobe, &next) ||
        !add_distribution(chosen, command, lobe.value[KEY_TABLE], next, option))
        return 0;
    if (is_valid(&chosen->mixture.lobe[chosen->mixture.count - 1].surface))
        return 1;
    const char *matrix = lobe.value[KEY_MATRIX], *alpha = lobe.value[KEY_ALPHA];
    complain(command,
             "%s: %s '%s' is singular, or maps slopes by less than 1e-18 or more than 1e18 times their length",
             lobe.where, matrix ? "matrix" : "alpha",
             matrix  ? matrix
             : alpha ? alpha
                     : "1");
    return 0;
}

static int add_all_lobes(chosen_surface *chosen, const char *command, const words *lobes)
{
    double sum = 0;
    for (size_t i = 0; i < lobes->count; i++)
        if (!add_lobe(chosen, command, lobes->item[i], (int)i))
            return 0;
    for (int i = 0; i < chosen->mixture.count; i++)
        sum += (double)chosen->mixture.lobe[i].weight;
    if (!(sum > 0))
        complain(command, "--lobe: the weights of all lobes are 0");
    return sum > 0;
}

/* With --alpha: a roughness that is out of the range of the table draws nothing, and is no mistake here. */
static int add_subject(chosen_surface *chosen, const char *command, const char *name, const char *alpha)
{
    vndf_surface plain = {NULL, 1, 1};
    if (!roughness_from(command, alpha, &plain))
        return 0;
    vndf_mixture_lobe lobe = {{NULL, plain.alpha_x, 0, 0, plain.alpha_y, 0, 0}, 1};
    return add_distribution(chosen, command, name, lobe, 0);
}

/* ---- the surface --------------------------------------------------------------------------------- */

int surface_open(chosen_surface *chosen, const arguments *given)
{
    const char *command = given->command, *alpha = option_value(given, "--alpha");
    const char *name = given->positional.count ? given->positional.item[0] : NULL;
    const words lobes = option_values(given, "--lobe");
    double theta = 0, phi = 0;
    chosen->tables = chosen->families = 0;
    chosen->mixture.count = 0;
    if (!lobes.count && !name)
        return complain(command, SURFACE_POSITIONAL " is missing; see `%s --help`", command), 0;
    if (lobes.count && name)
        return complain(command, "'%s' and --lobe are given; a lobe names its table by table=FILE", name), 0;
    if (lobes.count && alpha)
        return complain(command, "--alpha and --lobe are given; a lobe has its roughness by alpha=AX,AY"), 0;
    if (!option_value(given, "--theta"))
        return complain(command,
                        "--theta is missing: the angle from the normal to the incident direction, 0 to 180"),
               0;
    if (!option_number(given, "--theta", 0, 180, &theta) || !option_number(given, "--phi", -360, 360, &phi))
        return 0;
    chosen->wi = direction_from(theta, phi);
    if (lobes.count ? add_all_lobes(chosen, command, &lobes) : add_subject(chosen, command, name, alpha))
        return 1;
    surface_close(chosen);
    return 0;
}

void surface_close(chosen_surface *chosen)
{
    while (chosen->tables > 0)
        distribution_close(&chosen->table[--chosen->tables]);
    while (chosen->families > 0)
        vndf_family_free(chosen->family[--chosen->families]);
}
