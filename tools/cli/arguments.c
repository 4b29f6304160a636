#include "cli/arguments.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "core/nearest.h"

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

const char *nearest_word(const char *word, const char *const *candidates, size_t count)
{
    const char *nearest = NULL;
    size_t size = strlen(word), least = vndf_word_slip(size);
    for (size_t i = 0; i < count; i++)
        if (vndf_word_is_nearer(word, size, candidates[i], &least))
            nearest = candidates[i];
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

/* ---- the help as a table of options -------------------------------------------------------------- */

typedef struct option_term {
    const char *name, *value;         /* in the help */
    size_t name_length, value_length; /* value_length 0: a flag */
    size_t indent;                    /* of its item: 2 or 4 columns */
    int repeats;
} option_term;

/* The option behind *at, which begins at the help and moves on; 0: there is none. */
static int next_option(const char **at, option_term *term)
{
    const char *p = *at;
    size_t indent = 0;
    if (strncmp(p, ", -", 3) == 0)
        p += indent = 2;
    while ((indent != 2 && indent != 4) || *p != '-') {
        p = strchr(p, '\n');
        if (!p)
            return 0;
        indent = strspn(++p, " ");
        p += indent;
    }
    *term = (option_term){.name = p, .name_length = strcspn(p, " ,\n"), .indent = indent};
    p += term->name_length;
    if (*p == ' ' && p[1] != ' ') {
        term->value = ++p;
        while (*p && *p != '\n' && strncmp(p, "  ", 2) != 0 && strncmp(p, ", -", 3) != 0)
            p++;
        term->value_length = (size_t)(p - term->value);
        term->repeats = term->value_length > 4 && strncmp(p - 4, " ...", 4) == 0;
        term->value_length -= term->repeats ? 4 : 0;
    }
    *at = p;
    return 1;
}

static int find_option(const char *help, const char *name, size_t length, option_term *term)
{
    while (next_option(&help, term))
        if (term->name_length == length && memcmp(term->name, name, length) == 0)
            return 1;
    return 0;
}

/* The words of a value, red|green or dfg,energy, that the help has for it go to which[], in the order of the value. How
 * many: 0 after a complaint, or where the value may be anything. */
static size_t read_choices(const arguments *given, const option_term *term, const char *value,
                           int which[WORDS_MAX])
{
    char text[LISTED_LENGTH], known[LISTED_LENGTH], word[40];
    const char *choice[WORDS_MAX], *hint;
    size_t choices = 0, count = 0, letters;
    unsigned long long seen = 0;
    snprintf(text, sizeof text, "%.*s", (int)term->value_length, term->value);
    const int is_list = strchr(text, ',') != NULL;
    for (char *at = strtok(text, "|,"); at && choices < WORDS_MAX - 1; at = strtok(NULL, "|,"))
        choice[choices++] = at;
    choice[choices] = NULL;
    for (const char *at = value;; at += letters + 1) {
        size_t k = 0;
        letters = is_list ? strcspn(at, ",") : strlen(at);
        snprintf(word, sizeof word, "%.*s", (int)(letters < sizeof word ? letters : sizeof word - 1), at);
        while (k < choices && strcmp(word, choice[k]) != 0)
            k++;
        if (k == choices) {
            hint = nearest_word(word, choice, choices);
            list_words(choice, "", known);
            return complain(given->command, "%.*s '%s' is not %s%s%s%s", (int)term->name_length, term->name, word,
                            known, hint ? "; did you mean '" : "", hint ? hint : "", hint ? "'?" : ""),
                   0;
        }
        if (seen >> k & 1)
            return complain(given->command, "%.*s '%s' has '%s' twice", (int)term->name_length, term->name, value,
                            word),
                   0;
        seen |= 1ull << k;
        which[count++] = (int)k;
        if (!at[letters])
            return count;
    }
}

/* Whether the value of an option is a choice between words. */
static int has_choices(const option_term *term)
{
    for (size_t i = 0; i < term->value_length; i++)
        if (isupper((unsigned char)term->value[i]))
            return 0;
    return term->value_length > 0;
}

/* ---- reading ------------------------------------------------------------------------------------- */

/* The option that an unknown one may be: "-a" is --alpha, "--lang" --language, "--thta" --theta, "--output" -o. */
static option_term nearest_option(const char *help, const char *name)
{
    const size_t size = strlen(name), dashes = strspn(name, "-");
    size_t least = vndf_word_slip(size);
    option_term term, found = {.name = NULL};
    while (next_option(&help, &term)) {
        const int is_letter = size == dashes + 1;
        const int begins = is_letter ? term.name[1] == '-' && term.name[2] == name[dashes]
                                     : term.name_length > size && memcmp(term.name, name, size) == 0;
        if (begins ? least > 0 : !is_letter && vndf_word_is_nearer(term.name, term.name_length, name, &least))
            found = term;
        else if (!found.name && term.name_length == 2 && term.name[1] == name[dashes])
            found = term;
        least = begins ? 0 : least;
    }
    return found;
}

/* `value` is what it was given, or the word behind it, or NULL; 0. */
static int refuse_option(const arguments *given, const char *word, size_t length, const char *value)
{
    char name[32];
    option_term set;
    snprintf(name, sizeof name, "%.*s", length < sizeof name ? (int)length : (int)sizeof name - 1, word);
    const option_term hint = nearest_option(given->help, name);
    const char letter = name[strspn(name, "-")];
    if (isalpha((unsigned char)letter) && length <= 3 && value && isdigit((unsigned char)*value) &&
        find_option(given->help, "--set", 5, &set))
        complain(given->command, "there is no option '%s'; did you mean '--set %c=%s'?", name, letter, value);
    else if (hint.name)
        complain(given->command, "there is no option '%s'; did you mean '%.*s'?", name, (int)hint.name_length,
                 hint.name);
    else
        complain(given->command, "there is no option '%s'; `%s --help` lists them", name, given->command);
    return 0;
}

/* argv[*at] begins with '-'; moves *at on to the value if that is a word of its own. 1, or 0 after a complaint. */
static int take_option(arguments *given, int argc, char **argv, int *at)
{
    const char *word = argv[*at], *value = word, *next = *at + 1 < argc ? argv[*at + 1] : NULL;
    const char *equals = strncmp(word, "--", 2) == 0 ? strchr(word, '=') : NULL, *wrong = NULL;
    char name[32];
    int which[WORDS_MAX];
    option_term term, other;
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    if (!find_option(given->help, word, length, &term))
        return refuse_option(given, word, length, equals ? equals + 1 : next);
    snprintf(name, sizeof name, "%.*s", (int)length, word);
    if (term.value && equals)
        value = equals + 1;
    else if (term.value && next && !find_option(given->help, next, strlen(next), &other))
        value = argv[++*at];
    else if (term.value)
        return complain(given->command, "%s needs a value, as in %s %.*s", name, name, (int)term.value_length,
                        term.value),
               0;
    if (!term.value && equals)
        wrong = "takes no value";
    else if (!term.repeats && option_value(given, name))
        wrong = "is given twice";
    else if (given->count == WORDS_MAX)
        wrong = "is one option more than this program reads";
    if (wrong)
        return complain(given->command, "%s %s", name, wrong), 0;
    if (has_choices(&term) && !read_choices(given, &term, value, which))
        return 0;
    given->option[given->count].name = word;
    given->option[given->count].length = length;
    given->option[given->count++].value = value;
    return 1;
}

/* An option in column 4 of the help goes with the one above it in column 2. */
static int check_parts(const arguments *given)
{
    option_term term, above = {.name = NULL};
    int has_above = 0;
    for (const char *at = given->help; next_option(&at, &term);) {
        char name[32];
        snprintf(name, sizeof name, "%.*s", (int)term.name_length, term.name);
        const int is_given = option_value(given, name) != NULL;
        if (term.indent == 4 && is_given && !has_above)
            return complain(given->command, "%s is for %.*s, which is not given", name, (int)above.name_length,
                            above.name),
                   0;
        if (term.indent == 2) {
            above = term;
            has_above = is_given;
        }
    }
    return 1;
}

int arguments_read(arguments *given, int argc, char **argv)
{
    int options_end = 0;
    option_term set;
    for (int i = 0; i < argc; i++) {
        if (options_end || argv[i][0] != '-' || !argv[i][1]) {
            if (given->positional.count == WORDS_MAX)
                return complain(given->command, "these are more than %d words", WORDS_MAX), 0;
            if (strchr(argv[i], '=') && !strchr(argv[i], '/') && find_option(given->help, "--set", 5, &set))
                return complain(given->command, "'%s' is not expected; did you mean '--set %s'?", argv[i],
                                argv[i]),
                       0;
            given->positional.item[given->positional.count++] = argv[i];
        } else if (strcmp(argv[i], "--") == 0)
            options_end = 1;
        else if (!take_option(given, argc, argv, &i))
            return 0;
    }
    return check_parts(given);
}

/* ---- what was given ------------------------------------------------------------------------------ */

words option_values(const arguments *given, const char *name)
{
    words found = {.count = 0};
    option_term term;
    if (!find_option(given->help, name, strlen(name), &term)) {
        complain(given->command, "its help has no item %s, for which its code asks", name);
        abort();
    }
    for (size_t i = 0; i < given->count; i++)
        if (given->option[i].length == strlen(name) && memcmp(given->option[i].name, name, strlen(name)) == 0)
            found.item[found.count++] = given->option[i].value;
    return found;
}

const char *option_value(const arguments *given, const char *name)
{
    words found = option_values(given, name);
    return found.count ? found.item[0] : NULL;
}

size_t option_choices(const arguments *given, const char *name, int which[WORDS_MAX])
{
    const char *value = option_value(given, name);
    option_term term;
    return value && find_option(given->help, name, strlen(name), &term) ? read_choices(given, &term, value, which)
                                                                        : 0;
}

int option_choice(const arguments *given, const char *name, int otherwise)
{
    int which[WORDS_MAX];
    return option_choices(given, name, which) ? which[0] : otherwise;
}

const char *option_among(const arguments *given, const char *const *names)
{
    while (*names && !option_value(given, *names))
        names++;
    return *names;
}

const char *option_alone(const arguments *given, const char *const *names)
{
    const char *one = option_among(given, names), *other = NULL;
    char known[LISTED_LENGTH];
    for (const char *const *name = names; *name && one && !other; name++)
        other = *name != one && option_value(given, *name) ? *name : NULL;
    if (one && !other)
        return one;
    list_words(names, "", known);
    if (other)
        complain(given->command, "%s and %s are given; only one is possible of %s", one, other, known);
    else
        complain(given->command, "exactly one is needed of %s; `%s --help` has an example", known, given->command);
    return NULL;
}

void options_text(const arguments *given, const char *const *names, char *text, size_t size)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+.,:/=_";
    size_t at = strlen(text);
    for (; *names; names++) {
        const words values = option_values(given, *names);
        for (size_t i = 0; i < values.count && at < size; i++) {
            const char *word = values.item[i];
            const char *quote = *word && strspn(word, plain) == strlen(word) ? "" : "'";
            at += (size_t)snprintf(text + at, size - at, "%s%s %s", at ? " " : "", *names, quote);
            for (; *word && at < size; word++)
                at += (size_t)snprintf(text + at, size - at, *word == '\'' ? "'\\''" : "%c", *word);
            at += at < size ? (size_t)snprintf(text + at, size - at, "%s", quote) : 0;
        }
    }
}

/* ---- numbers ------------------------------------------------------------------------------------- */

/* strtod alone would also take nan, inf, hexadecimal numbers and leading blanks. */
size_t parse_numbers(const char *command, const char *what, const char *text, double low, double high,
                     size_t least, size_t most, double *numbers)
{
    const char *form = most > 1 ? "a number, or numbers between commas" : "a number";
    char why[160] = "";
    size_t count = 0;
    for (const char *at = text; !*why; at++) {
        char *end = NULL;
        const size_t length = strspn(at, "+-.0123456789eE");
        const double number = length ? strtod(at, &end) : 0;
        const int is_read = end && end > at && end <= at + length;
        if (is_read && *end && !strchr(", ", *end))
            snprintf(why, sizeof why, "is not %s: '%.40s' stands behind it", form, end);
        else if (!is_read || *end == ' ')
            snprintf(why, sizeof why, "is not %s", form);
        else if (isinf(number))
            snprintf(why, sizeof why, "is too large for a double");
        else if (!(number >= low && number <= high))
            snprintf(why, sizeof why, "is not in the range from %.9g to %.9g", low, high);
        else if (count == most || (!*end && count + 1 < least))
            snprintf(why, sizeof why, "has too %s numbers: it takes %zu", count == most ? "many" : "few",
                     count == most ? most : least);
        else {
            numbers[count++] = number;
            at = end;
            if (!*at)
                return count;
        }
    }
    return complain(command, "%s '%s' %s", what, text, why), 0;
}

int option_number(const arguments *given, const char *name, double low, double high, double *number)
{
    const char *text = option_value(given, name);
    return !text || parse_numbers(given->command, name, text, low, high, 1, 1, number) == 1;
}

int option_count(const arguments *given, const char *name, double low, double high, unsigned long long *count)
{
    double number = (double)*count;
    if (!option_number(given, name, low, high, &number))
        return 0;
    if (number != floor(number))
        return complain(given->command, "%s '%s' is not a whole number", name, option_value(given, name)), 0;
    *count = (unsigned long long)number;
    return 1;
}
