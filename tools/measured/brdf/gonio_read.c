#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measured/brdf/gonio.h"
#include "measured/surface/grid_text.h"

enum { LINE_MAX = 512, COLUMNS = 3 };

static const double degree = 3.14159265358979323846 / 180;

typedef enum column { THETA_I, THETA_O, BRDF, INTENSITY, NAMES } column;

static const char *const column_names[NAMES] = {"theta_i", "theta_o", "brdf", "intensity"};

typedef struct reader {
    grid_text text;
    column columns[COLUMNS];
    const char *name;
    refusal *why;
} reader;

/* Splits the current line at commas into words; how many there are, at most COLUMNS + 1, or -1 and the reason. */
static int split_line(reader *r, char words[COLUMNS + 1][WORD_MAX])
{
    char line[LINE_MAX];
    size_t length = 0;
    int count = 0;
    for (size_t at = r->text.at; at < r->text.size && r->text.bytes[at] != '\n'; at++) {
        if (length == LINE_MAX)
            return refuse_data(r->why, r->name, "line %zu: more than %d characters", r->text.line, LINE_MAX) - 1;
        line[length++] = r->text.bytes[at] == ',' ? ' ' : r->text.bytes[at];
    }
    grid_text inside = {line, length, 0, 1};
    while (count <= COLUMNS && text_word(&inside, words[count]))
        count++;
    return count > 0 && words[0][0] == '#' ? 0 : count;
}

/* The words of the next line that has some; 0 at the end, -1 and the reason if they are not COLUMNS. */
static int next_line(reader *r, char words[COLUMNS + 1][WORD_MAX])
{
    int count;
    do {
        count = split_line(r, words);
        if (count == COLUMNS || count < 0)
            return count;
        if (count > 0)
            return refuse_data(r->why, r->name,
                               "line %zu: %s numbers or names; %d are needed, separated by commas", r->text.line,
                               count < COLUMNS ? "too few" : "too many", COLUMNS) -
                   1;
    } while (text_line(&r->text));
    return 0;
}

static int read_header(reader *r)
{
    char words[COLUMNS + 1][WORD_MAX];
    int seen = 0;
    int count = next_line(r, words);
    if (count <= 0)
        return count < 0 ? 0 : refuse_data(r->why, r->name, "no header line; theta_i,theta_o,brdf is needed");
    for (int i = 0; i < COLUMNS; i++) {
        int k = 0;
        while (k < NAMES && strcmp(words[i], column_names[k]) != 0)
            k++;
        if (k == NAMES)
            return refuse_data(r->why, r->name,
                               "line %zu: a column is called '%.40s'; theta_i, theta_o (degrees) and brdf "
                               "or intensity are known",
                               r->text.line, words[i]);
        r->columns[i] = (column)k;
        seen |= 1 << (k == INTENSITY ? BRDF : k);
    }
    return seen == 7 || refuse_data(r->why, r->name,
                                    "line %zu: a column is named twice; theta_i, theta_o and brdf or "
                                    "intensity are needed",
                                    r->text.line);
}

static int read_point(const reader *r, char words[COLUMNS + 1][WORD_MAX], gonio_point *point)
{
    double numbers[NAMES] = {0, 0, 0, -1};
    for (int i = 0; i < COLUMNS; i++)
        if (!word_number(words[i], &numbers[r->columns[i]]) || isnan(numbers[r->columns[i]]))
            return refuse_data(r->why, r->name, "line %zu: %s is '%.40s', which is no number", r->text.line,
                               column_names[r->columns[i]], words[i]);
    if (!(numbers[THETA_I] >= 0 && numbers[THETA_I] <= 90))
        return refuse_data(r->why, r->name, "line %zu: theta_i is %.10g; it must be from 0 to 90 degrees",
                           r->text.line, numbers[THETA_I]);
    if (!(fabs(numbers[THETA_O]) <= 90))
        return refuse_data(r->why, r->name, "line %zu: theta_o is %.10g; it must be from -90 to 90 degrees",
                           r->text.line, numbers[THETA_O]);
    *point = (gonio_point){numbers[THETA_I] * degree, numbers[THETA_O] * degree, numbers[BRDF]};
    if (numbers[INTENSITY] != -1)
        point->f = numbers[INTENSITY] / fmax(cos(point->theta_o), 1e-9);
    if (fabs(point->f) <= 1e30)
        return 1;
    return refuse_data(r->why, r->name, "line %zu: the value is too large", r->text.line);
}

static int add(gonio_points *made, size_t *room, const gonio_point *point)
{
    if (made->count == *room) {
        size_t larger = 2 * *room + 256;
        gonio_point *at = realloc(made->at, larger * sizeof *at);
        if (!at)
            return 0;
        made->at = at;
        *room = larger;
    }
    made->at[made->count++] = *point;
    return 1;
}

static int read_points(reader *r, gonio_points *made)
{
    char words[COLUMNS + 1][WORD_MAX];
    size_t room = 0;
    gonio_point point;
    while (text_line(&r->text)) {
        int count = next_line(r, words);
        if (count == 0)
            break;
        if (count < 0 || !read_point(r, words, &point))
            return 0;
        if (made->count == GONIO_POINTS_MAX)
            return refuse_data(r->why, r->name, "line %zu: more than %d rows", r->text.line, GONIO_POINTS_MAX);
        if (!add(made, &room, &point))
            return refuse_data(r->why, r->name, "there is no memory for %zu rows", made->count);
    }
    return 1;
}

int gonio_read(gonio_points *made, const char *name, const char *bytes, size_t size, refusal *why)
{
    reader r = {text_from(bytes, size), {THETA_I, THETA_O, BRDF}, name, why};
    *made = (gonio_points){NULL, 0};
    if (read_header(&r) && read_points(&r, made))
        return 1;
    gonio_free(made);
    return 0;
}

void gonio_free(gonio_points *freed)
{
    free(freed->at);
    *freed = (gonio_points){NULL, 0};
}
