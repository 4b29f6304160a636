#include "cli/surface.h"

#include <stdio.h>
#include <string.h>

#include "command.h"

enum { LOBE_LENGTH = 4096 };

enum { KEY_TABLE, KEY_PARAMETER, KEY_WEIGHT, KEY_ALPHA, KEY_MATRIX, KEY_MEAN, KEYS };
static const char *const key_names[KEYS] = {"table", "parameter", "weight", "alpha", "matrix", "mean"};

/* ---- the words of a lobe ---- */

typedef struct lobe_text {
    const char *command;
    char where[16]; /* "--lobe 2": opens messages */
    char text[LOBE_LENGTH];
    const char *value[KEYS]; /* in text, or NULL */
} lobe_text;

static int refuse_key(const lobe_text *lobe, const char *word)
{
    const char *hint = nearest_word(word, key_names, KEYS);
    if (hint)
        complain(lobe->command, "%s: there is no key '%.40s'; did you mean '%s'?", lobe->where, word, hint);
    else
        complain(lobe->command,
                 "%s: there is no key '%.40s'; known are table, parameter, weight, alpha, matrix, mean",
                 lobe->where, word);
    return 0;
}

/* "alpha=0.2" into lobe->value. 1, or 0 after a complaint. */
static int take_key(lobe_text *lobe, char *word)
{
    char *equals = strchr(word, '=');
    if (!equals) {
        complain(lobe->command, "%s: '%.40s' is not KEY=VALUE", lobe->where, word);
        return 0;
    }
    *equals = '\0';
    for (int key = 0; key < KEYS; key++) {
        if (strcmp(word, key_names[key]) != 0)
            continue;
        if (lobe->value[key]) {
            complain(lobe->command, "%s: %s is given twice", lobe->where, word);
            return 0;
        }
        lobe->value[key] = equals + 1;
        return 1;
    }
    return refuse_key(lobe, word);
}

static int split_lobe(lobe_text *lobe, const char *given)
{
    static const char blanks[] = " \t\r\n";
    if (strlen(given) >= sizeof lobe->text) {
        complain(lobe->command, "%s has more than %d characters", lobe->where, LOBE_LENGTH - 1);
        return 0;
    }
    strcpy(lobe->text, given);
    for (char *at = lobe->text + strspn(lobe->text, blanks); *at;) {
        char *word = at;
        at += strcspn(at, blanks);
        if (*at)
            *at++ = '\0';
        at += strspn(at, blanks);
        if (!take_key(lobe, word))
            return 0;
    }
    return 1;
}

/* ---- the numbers of a lobe ---- */

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

static int check_keys(const lobe_text *lobe)
{
    if (!lobe->value[KEY_TABLE])
        complain(lobe->command, "%s: table=" SURFACE_POSITIONAL " is missing", lobe->where);
    else if (lobe->value[KEY_ALPHA] && lobe->value[KEY_MATRIX])
        complain(lobe->command, "%s has both alpha and matrix; one of them is possible", lobe->where);
    else
        return 1;
    return 0;
}

static int read_numbers(const lobe_text *lobe, vndf_mixture_lobe *to)
{
    double weight = 1, alpha[2] = {1, 1}, matrix[4], mean[2] = {0, 0};
    if (!read_key(lobe, KEY_WEIGHT, 0, 1e30, 1, 1, &weight) ||
        !read_key(lobe, KEY_ALPHA, 1e-18, 1e18, 1, 2, alpha) ||
        !read_key(lobe, KEY_MATRIX, -1e18, 1e18, 4, 4, matrix) || !read_key(lobe, KEY_MEAN, -1e6, 1e6, 2, 2, mean))
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

/* ---- the surface ---- */

static int is_valid(const vndf_affine *surface)
{
    vndf_mixture alone = {1, {{*surface, 1}}};
    vndf_vec3 up = {0, 0, 1};
    return vndf_mixture_view_from(&alone, up).count == 1;
}

/* Adds a lobe of the distribution. 1, or 0 after a complaint: there are too many. */
static int put_lobe(chosen_surface *chosen, const char *command, vndf_mixture_lobe lobe, int option)
{
    if (chosen->mixture.count == VNDF_MIXTURE_LOBES) {
        complain(command, "--lobe: these are more than %d lobes; a family counts as two", VNDF_MIXTURE_LOBES);
        return 0;
    }
    chosen->option[chosen->mixture.count] = option;
    chosen->mixture.lobe[chosen->mixture.count++] = lobe;
    return 1;
}

/* A lobe of a table or a closed form. 1, or 0 after a complaint. */
static int add_table(chosen_surface *chosen, const char *command, const char *name, vndf_mixture_lobe lobe,
                     int option)
{
    chosen_distribution *table = &chosen->table[chosen->tables];
    if (!distribution_open(table, command, name))
        return 0;
    chosen->tables++;
    lobe.surface.distribution = table->distribution;
    return put_lobe(chosen, command, lobe, option);
}

/* A number between the first and the last knot, as floats. */
static int read_parameter(const char *command, const vndf_family *family, const char *what, const char *text,
                          double *p)
{
    vndf_family_facts facts = vndf_family_info(family);
    if (!parse_numbers(command, what, text, -1e30, 1e30, 1, 1, p))
        return 0;
    if ((float)*p >= facts.low && (float)*p <= facts.high)
        return 1;
    complain(command, "%s '%s' is not in the range of the family, from %.7g to %.7g", what, text,
             (double)facts.low, (double)facts.high);
    return 0;
}

/* What names a distribution: "ggx", "beckmann", a table's file or FILE.vndfs@P; or FILE.vndfs and P apart. */
typedef struct subject_words {
    const char *name, *parameter; /* the latter may be NULL */
    const char *what;             /* opens a message about the parameter */
} subject_words;

/* Lobes of a family at a parameter. 1, or 0 after a complaint. */
static int add_family(chosen_surface *chosen, const char *command, const subject_words *subject,
                      vndf_mixture_lobe lobe, int option)
{
    double p;
    vndf_mixture at;
    vndf_family *family = family_open(command, subject->name);
    if (!family)
        return 0;
    chosen->family[chosen->families++] = family;
    if (!read_parameter(command, family, subject->what, subject->parameter, &p))
        return 0;
    vndf_family_at(family, (float)p, &lobe.surface, &at);
    for (int i = 0; i < at.count; i++) {
        at.lobe[i].weight *= lobe.weight;
        if (!put_lobe(chosen, command, at.lobe[i], option))
            return 0;
    }
    return 1;
}

/* "FILE.vndfs@P": the file's name is copied. */
static int add_family_at(chosen_surface *chosen, const char *command, const subject_words *subject,
                         vndf_mixture_lobe lobe, int option)
{
    char path[LOBE_LENGTH];
    const subject_words apart = {path, family_parameter(subject->name), subject->what};
    size_t length = (size_t)(apart.parameter - subject->name) - 1;
    if (subject->parameter)
        complain(command, "%s '%s' is given, and '%s' says one already", subject->what, subject->parameter,
                 subject->name);
    else if (length >= sizeof path)
        complain(command, "the name of the family's file has more than %d characters", LOBE_LENGTH - 1);
    else {
        memcpy(path, subject->name, length);
        path[length] = '\0';
        return add_family(chosen, command, &apart, lobe, option);
    }
    return 0;
}

/* Lobes of any distribution. 1, or 0 after a complaint. */
static int add_any(chosen_surface *chosen, const char *command, const subject_words *subject,
                   vndf_mixture_lobe lobe, int option)
{
    if (family_parameter(subject->name))
        return add_family_at(chosen, command, subject, lobe, option);
    if (subject->parameter)
        return add_family(chosen, command, subject, lobe, option);
    if (!is_family_file(subject->name))
        return add_table(chosen, command, subject->name, lobe, option);
    complain(command, "'%s' is a family; say at which parameter, as in %s@2.5", subject->name, subject->name);
    return 0;
}

static int add_lobe(chosen_surface *chosen, const char *command, const char *given, int option)
{
    char what[32];
    lobe_text lobe = {.command = command};
    vndf_mixture_lobe next;
    snprintf(lobe.where, sizeof lobe.where, "--lobe %d", option + 1);
    snprintf(what, sizeof what, "%s: parameter", lobe.where);
    if (!split_lobe(&lobe, given) || !check_keys(&lobe) || !read_numbers(&lobe, &next))
        return 0;
    const subject_words subject = {lobe.value[KEY_TABLE], lobe.value[KEY_PARAMETER], what};
    if (!add_any(chosen, command, &subject, next, option))
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
    const subject_words subject = {name, NULL, "the parameter"};
    vndf_surface plain = {NULL, 1, 1};
    if (!roughness_from(command, alpha, &plain))
        return 0;
    vndf_mixture_lobe lobe = {{NULL, plain.alpha_x, 0, 0, plain.alpha_y, 0, 0}, 1};
    return add_any(chosen, command, &subject, lobe, 0);
}

static int check_subject(const char *command, const aim_words *aim, const words *positional)
{
    if (!aim->lobes.count && !positional->count)
        complain(command, SURFACE_POSITIONAL " is missing; see `%s --help`", command);
    else if (aim->lobes.count && positional->count)
        complain(command, "'%s' and --lobe are given; a lobe names its table by table=FILE",
                 only_word(positional));
    else if (aim->lobes.count && aim->alpha.count)
        complain(command, "--alpha and --lobe are given; a lobe has its roughness by alpha=AX,AY");
    else
        return 1;
    return 0;
}

static int direction_of_words(const char *command, const aim_words *aim, vndf_vec3 *wi)
{
    double theta = 0, phi = 0;
    if (!aim->theta.count) {
        complain(command, "--theta is missing: the angle from the normal to the incident direction, 0 to 180");
        return 0;
    }
    if (!option_number(command, "--theta", &aim->theta, 0, 180, &theta) ||
        !option_number(command, "--phi", &aim->phi, -360, 360, &phi))
        return 0;
    *wi = direction_from(theta, phi);
    return 1;
}

int surface_open(chosen_surface *chosen, const char *command, const aim_words *aim, const words *positional)
{
    chosen->tables = chosen->families = 0;
    chosen->mixture.count = 0;
    if (!check_subject(command, aim, positional))
        return 0;
    int good = aim->lobes.count ? add_all_lobes(chosen, command, &aim->lobes)
                                : add_subject(chosen, command, only_word(positional), only_word(&aim->alpha));
    if (good && direction_of_words(command, aim, &chosen->wi))
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

/* ---- what it is ---- */

float surface_ndf(const chosen_surface *chosen, vndf_vec3 wm)
{
    const vndf_mixture *m = &chosen->mixture;
    return m->count == 1 ? vndf_affine_ndf(&m->lobe[0].surface, wm) : vndf_mixture_ndf(m, wm);
}

float surface_lambda(const chosen_surface *chosen)
{
    const vndf_mixture *m = &chosen->mixture;
    return m->count == 1 ? vndf_affine_lambda(&m->lobe[0].surface, chosen->wi)
                         : vndf_mixture_lambda(m, chosen->wi);
}

float surface_g1(const chosen_surface *chosen)
{
    const vndf_mixture *m = &chosen->mixture;
    return m->count == 1 ? vndf_affine_g1(&m->lobe[0].surface, chosen->wi) : vndf_mixture_g1(m, chosen->wi);
}
