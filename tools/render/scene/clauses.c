/* Clauses of a statement, and the numbers, choices and names in them. */
#include "render/scene/reader.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"

/* ---- clauses ---- */

static clause *find_clause(const word *w, clause *clauses, size_t count)
{
    for (size_t i = 0; i < count && !w->quoted; i++)
        if (strcmp(w->text, clauses[i].keyword) == 0)
            return &clauses[i];
    return NULL;
}

static int unknown_clause(scene_reader *r, const statement *s, const word *at, const clause *clauses, size_t count)
{
    const char *names[48];
    char what[64];
    for (size_t i = 0; i < count; i++)
        names[i] = clauses[i].keyword;
    snprintf(what, sizeof what, "word of '%.32s'", s->words[0].text);
    return reader_unknown(r, at, what, names, count);
}

/* Takes the values of c from words[*at] on. Takes required values as they are, since a name may look like a
 * keyword. */
static int take_values(scene_reader *r, const statement *s, size_t *at, clause *c, clause *clauses, size_t count)
{
    c->values = s->words + *at;
    while (c->count < c->most && *at < s->count) {
        if (c->count >= c->least && find_clause(&s->words[*at], clauses, count))
            break;
        c->count++;
        ++*at;
    }
    if (c->count >= c->least)
        return 1;
    const word *last = &s->words[s->count - 1];
    const word end = {NULL, last->line, last->end, last->end, 0, 0};
    return reader_refuse(r, &end, "the statement ends before all of '%s %s' was there", c->keyword, c->takes);
}

int reader_clauses(scene_reader *r, const statement *s, size_t from, clause *clauses, size_t count)
{
    size_t at = from;
    while (at < s->count) {
        const word *w = &s->words[at];
        clause *c = find_clause(w, clauses, count);
        if (!c)
            return unknown_clause(r, s, w, clauses, count);
        if (c->at)
            return reader_refuse(r, w, "'%s' stands in this statement twice", c->keyword);
        c->at = w;
        at++;
        if (!take_values(r, s, &at, c, clauses, count))
            return 0;
    }
    for (size_t i = 0; i < count; i++)
        if (clauses[i].needed && !clauses[i].at)
            return reader_refuse(r, &s->words[0], "'%s' needs '%s %s'", s->words[0].text, clauses[i].keyword,
                                 clauses[i].takes);
    return 1;
}

/* ---- numbers ---- */

/* strtod alone would also accept nan, inf, hexadecimal numbers and leading blanks. */
static int parse(const char *text, double *number)
{
    char *end;
    size_t length = strspn(text, "+-.0123456789eE");
    *number = strtod(text, &end);
    return length && end == text + length && !*end;
}

static int in_range(scene_reader *r, const clause *c, size_t i, double low, double high, double *number)
{
    const word *w = &c->values[i];
    if (!parse(w->text, number))
        return reader_refuse(r, w, "'%.64s' is no number; it must be '%s %s'", w->text, c->keyword, c->takes);
    if (!(*number >= low && *number <= high))
        return reader_refuse(r, w, "%s is %.9g, it must be from %.9g to %.9g", c->keyword, *number, low, high);
    return 1;
}

int reader_number(scene_reader *r, const clause *c, size_t i, double low, double high, float *number)
{
    double value;
    if (!in_range(r, c, i, low, high, &value))
        return 0;
    *number = (float)value;
    return 1;
}

int reader_whole(scene_reader *r, const clause *c, size_t i, double low, double high, unsigned *number)
{
    double value;
    if (!in_range(r, c, i, low, high, &value))
        return 0;
    if (value != floor(value))
        return reader_refuse(r, &c->values[i], "%s is %.9g, it must be a whole number", c->keyword, value);
    *number = (unsigned)value;
    return 1;
}

int reader_three(scene_reader *r, const clause *c, double low, double high, float numbers[3])
{
    for (size_t i = 0; i < 3; i++)
        if (!reader_number(r, c, i, low, high, &numbers[i]))
            return 0;
    return 1;
}

int reader_vector(scene_reader *r, const clause *c, vndf_vec3 *v)
{
    float numbers[3];
    if (!reader_three(r, c, -SCENE_FAR, SCENE_FAR, numbers))
        return 0;
    *v = vec(numbers[0], numbers[1], numbers[2]);
    return 1;
}

/* ---- words ---- */

int reader_choice(scene_reader *r, const clause *c, const char *const *names, size_t count, unsigned *choice)
{
    char what[64];
    for (*choice = 0; *choice < count; ++*choice)
        if (strcmp(c->values[0].text, names[*choice]) == 0)
            return 1;
    snprintf(what, sizeof what, "choice for '%s'", c->keyword);
    return reader_unknown(r, &c->values[0], what, names, count);
}

int reader_name(scene_reader *r, const statement *s, const char *what, const word **name)
{
    if (s->count < 2)
        return reader_refuse(r, &s->words[0], "'%s' needs a name, as in '%s %s'", what, what,
                             strcmp(what, "image") == 0  ? "sky file sky.pfm"
                             : strcmp(what, "lobe") == 0 ? "haze distribution ggx alpha 0.4"
                                                         : "wall matte colour 0.5 0.5 0.5");
    *name = &s->words[1];
    size_t length = strlen((*name)->text);
    if (length > 0 && length <= SCENE_NAME_MAX)
        return 1;
    return reader_refuse(r, *name, "a name has 1 to %d letters", SCENE_NAME_MAX);
}

int reader_image(scene_reader *r, const clause *c, const image **found)
{
    const char *names[SCENE_IMAGES_MAX];
    const scene *s = r->made;
    for (size_t i = 0; i < s->image_count; i++) {
        names[i] = s->image_names[i];
        if (strcmp(names[i], c->values[0].text) == 0) {
            *found = &s->images[i];
            return 1;
        }
    }
    if (!s->image_count)
        return reader_refuse(r, &c->values[0], "no image is defined before this, so '%.64s' is none",
                             c->values[0].text);
    return reader_unknown(r, &c->values[0], "image that is defined before this", names, s->image_count);
}

char *reader_path(scene_reader *r, const word *at)
{
    size_t folder = at->text[0] == '/' ? 0 : r->folder, length = strlen(at->text);
    char *path = length ? malloc(folder + length + 1) : NULL;
    if (!path) {
        reader_refuse(r, at, length ? "there is no memory for this path" : "a path is empty");
        return NULL;
    }
    memcpy(path, r->name, folder);
    memcpy(path + folder, at->text, length + 1);
    const char *role = files_note_input(path);
    if (!role)
        return path;
    reader_refuse(r, at, "this file is %s as well", role);
    free(path);
    return NULL;
}

char *reader_copy(scene_reader *r, const word *at)
{
    size_t size = strlen(at->text) + 1;
    char *copy = malloc(size);
    if (!copy)
        reader_refuse(r, at, "there is no memory for '%.64s'", at->text);
    else
        memcpy(copy, at->text, size);
    return copy;
}
