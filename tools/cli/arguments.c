#include "cli/arguments.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

int complain(const char *command, const char *format, ...)
{
    va_list list;
    fprintf(stderr, "%s: ", command);
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fputc('\n', stderr);
    return STATUS_USE;
}

/* ---- hints --------------------------------------------------------------------------------------- */

enum { HINT_LENGTH = 32 };

static size_t least_of(size_t a, size_t b)
{
    return a < b ? a : b;
}

static int same_letter(char a, char b)
{
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

/* Edits that make b of a: a letter inserted, deleted or replaced, two neighbours swapped. Three rows of the table at a
 * time: row[i % 3] has the edits of the first i letters. */
static size_t edit_distance(const char *a, const char *b)
{
    size_t row[3][HINT_LENGTH + 1], length = strlen(b), i;
    for (size_t j = 0; j <= length; j++)
        row[0][j] = j;
    for (i = 1; a[i - 1]; i++) {
        size_t *now = row[i % 3], *before = row[(i + 2) % 3], *earlier = row[(i + 1) % 3];
        now[0] = i;
        for (size_t j = 1; j <= length; j++) {
            now[j] =
                least_of(before[j - 1] + !same_letter(a[i - 1], b[j - 1]), least_of(before[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]))
                now[j] = least_of(now[j], earlier[j - 2] + 1);
        }
    }
    return row[(i - 1) % 3][length];
}

/* More than two edits, or more than one of a short word, make another word. */
const char *nearest_word(const char *word, const char *const *candidates, size_t count)
{
    const char *nearest = NULL;
    size_t least = strlen(word) > 4 ? 3 : 2;
    if (strlen(word) > HINT_LENGTH)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        size_t length = strlen(candidates[i]);
        size_t distance = length > HINT_LENGTH ? length : edit_distance(word, candidates[i]);
        if (distance < least && 2 * distance < length) {
            least = distance;
            nearest = candidates[i];
        }
    }
    return nearest;
}

void list_words(const char *const *candidates, const char *before, char listed[LISTED_LENGTH])
{
    size_t at = 0;
    listed[0] = '\0';
    for (size_t i = 0; candidates[i] && at < LISTED_LENGTH; i++) {
        const char *between = i == 0 ? "" : candidates[i + 1] ? ", " : " or ";
        at += (size_t)snprintf(listed + at, LISTED_LENGTH - at, "%s%s%s", between, before, candidates[i]);
    }
}

int word_among(const char *command, const char *what, const char *word, const char *const *candidates)
{
    char known[LISTED_LENGTH];
    size_t count = 0;
    for (; candidates[count]; count++)
        if (strcmp(word, candidates[count]) == 0)
            return (int)count;
    const char *hint = nearest_word(word, candidates, count);
    list_words(candidates, "", known);
    complain(command, "%s '%.80s' is not %s%s%s%s", what, word, known, hint ? "; did you mean '" : "",
             hint ? hint : "", hint ? "'?" : "");
    return -1;
}

/* ---- options ------------------------------------------------------------------------------------- */

static const option_form *find_option(const command_form *form, const char *word, size_t length)
{
    for (size_t i = 0; i < form->option_count; i++) {
        const option_form *candidate = &form->options[i];
        if (strlen(candidate->name) == length && memcmp(candidate->name, word, length) == 0)
            return candidate;
    }
    return NULL;
}

/* `value` is the word behind it, or NULL. */
static int refuse_option(const command_form *form, const char *word, size_t length, const char *value)
{
    char name[HINT_LENGTH + 1];
    const char *names[WORDS_MAX];
    size_t count = form->option_count < WORDS_MAX ? form->option_count : WORDS_MAX;
    snprintf(name, sizeof name, "%.*s", length < HINT_LENGTH ? (int)length : HINT_LENGTH, word);
    for (size_t i = 0; i < count; i++)
        names[i] = form->options[i].name;
    const char *hint = nearest_word(name, names, count);
    if (isalpha((unsigned char)name[1]) && !name[2]) { /* "-a 0.3" */
        if (value && isdigit((unsigned char)*value) && find_option(form, "--set", 5))
            return complain(form->command, "there is no option '%s'; did you mean '--set %s=%s'?", name, name + 1,
                            value);
        for (size_t i = 0; i < count && !hint; i++)
            hint = strncmp(names[i], "--", 2) == 0 && names[i][2] == name[1] ? names[i] : NULL;
    }
    if (hint)
        return complain(form->command, "there is no option '%s'; did you mean '%s'?", name, hint);
    return complain(form->command, "there is no option '%s'; `%s --help` lists them", name, form->command);
}

static int store_word(const command_form *form, const option_form *option, const char *value)
{
    if (option->values->count >= option->most)
        return option->most == 1
                   ? complain(form->command, "%s is given twice", option->name)
                   : complain(form->command, "%s is given more than %zu times", option->name, option->most);
    option->values->item[option->values->count++] = value;
    return PARSE_GO_ON;
}

/* argv[*at] begins with '-'; moves *at on to the value if that is a word of its own. */
static int take_option(const command_form *form, int argc, char **argv, int *at)
{
    const char *word = argv[*at];
    const char *equals = strncmp(word, "--", 2) == 0 ? strchr(word, '=') : NULL;
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const option_form *option = find_option(form, word, length);
    if (!option)
        return refuse_option(form, word, length, *at + 1 < argc ? argv[*at + 1] : NULL);
    if (!option->takes_value && equals)
        return complain(form->command, "%s takes no value", option->name);
    if (!option->takes_value)
        return store_word(form, option, word);
    if (equals)
        return store_word(form, option, equals + 1);
    if (*at + 1 >= argc)
        return complain(form->command, "%s needs a value", option->name);
    *at += 1;
    return store_word(form, option, argv[*at]);
}

static int take_positional(const command_form *form, const char *word, words *positional)
{
    if (positional->count < form->positional_max) {
        positional->item[positional->count++] = word;
        return PARSE_GO_ON;
    }
    if (form->positional_max == 0)
        return complain(form->command, "'%s' is not expected; only options are", word);
    return complain(form->command, "'%s' is one word too many; expected only %s", word, form->positional);
}

/* Of take_form, while it runs. */
static form_taker *taker;
static void *taker_user;

void take_form(int (*run)(int argc, char **argv), form_taker *take, void *user)
{
    taker = take;
    taker_user = user;
    run(0, NULL);
    taker = NULL;
}

int parse_arguments(const command_form *form, int argc, char **argv, words *positional)
{
    int result = PARSE_GO_ON;
    int options_end = 0;
    if (taker) {
        taker(form, taker_user);
        return STATUS_GOOD;
    }
    for (int i = 0; i < argc && result == PARSE_GO_ON; i++) {
        int is_option = !options_end && argv[i][0] == '-' && argv[i][1] != '\0';
        if (is_option && (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0))
            return fputs(form->help, stdout) < 0 ? STATUS_USE : STATUS_GOOD;
        if (is_option && strcmp(argv[i], "--") == 0)
            options_end = 1;
        else if (is_option)
            result = take_option(form, argc, argv, &i);
        else
            result = take_positional(form, argv[i], positional);
    }
    if (result == PARSE_GO_ON && positional->count < form->positional_min)
        return complain(form->command, "%s is missing; see `%s --help`", form->positional, form->command);
    return result;
}

const char *only_word(const words *values)
{
    return values->count ? values->item[0] : NULL;
}

/* ---- numbers ------------------------------------------------------------------------------------- */

/* Says what is wrong with a text of numbers, at the letter where reading stopped; 0. */
static size_t refuse_numbers(const char *command, const char *what, const char *text, const char *at, size_t most)
{
    const char *form = most > 1 ? "a number, or numbers between commas" : "a number";
    if (at > text && isdigit((unsigned char)at[-1]) && *at != ' ')
        complain(command, "%s '%s' is not %s: '%s' stands behind it", what, text, form, at);
    else
        complain(command, "%s '%s' is not %s", what, text, form);
    return 0;
}

/* strtod alone would also take nan, inf, hexadecimal numbers and leading blanks. */
size_t parse_numbers(const char *command, const char *what, const char *text, double low, double high,
                     size_t least, size_t most, double *numbers)
{
    const char *why = "has too few numbers";
    char range[128];
    size_t count = 0;
    for (const char *at = text;; at++) {
        char *end = NULL;
        size_t length = strspn(at, "+-.0123456789eE");
        double number = length ? strtod(at, &end) : 0;
        if (!end || end == at || end > at + length || (*end && *end != ','))
            return refuse_numbers(command, what, text, end && end <= at + length ? end : at, most);
        if (isinf(number))
            why = "is too large for a double";
        else if (!(number >= low && number <= high)) {
            snprintf(range, sizeof range, "is not in the range from %.9g to %.9g", low, high);
            why = range;
        } else if (count == most)
            why = "has too many numbers";
        else {
            numbers[count++] = number;
            at = end;
            if (*at)
                continue;
            if (count >= least)
                return count;
        }
        complain(command, "%s '%s' %s", what, text, why);
        return 0;
    }
}

int option_number(const char *command, const char *what, const words *values, double low, double high,
                  double *number)
{
    const char *text = only_word(values);
    return !text || parse_numbers(command, what, text, low, high, 1, 1, number) == 1;
}

int option_count(const char *command, const char *what, const words *values, double low, double high,
                 unsigned long long *count)
{
    double number = 0;
    if (!only_word(values))
        return 1;
    if (!option_number(command, what, values, low, high, &number))
        return 0;
    if (number != floor(number))
        return complain(command, "%s '%s' is not a whole number", what, only_word(values)), 0;
    *count = (unsigned long long)number;
    return 1;
}
