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

/* ---- hints --------------------------------------------------------------------------------------- */

enum { HINT_LENGTH = 32 };

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

size_t words_among(const char *command, const char *what, const char *list, const char *const *candidates,
                   int *which)
{
    size_t count = 0;
    for (const char *at = list;; at++) {
        char word[32];
        size_t letters = strcspn(at, ",");
        snprintf(word, sizeof word, "%.*s", (int)(letters < sizeof word ? letters : sizeof word - 1), at);
        int found = word_among(command, what, word, candidates);
        if (found < 0)
            return 0;
        for (size_t k = 0; k < count; k++)
            if (which[k] == found)
                return complain(command, "%s: '%s' stands there twice", what, word), 0;
        which[count++] = found;
        at += letters;
        if (!*at)
            return count;
    }
}

/* ---- options ------------------------------------------------------------------------------------- */

int next_option(const char **at, option_term *term)
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
    *term = (option_term){.name = p, .name_length = strcspn(p, " ,\n")};
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

/* The words of --channel red|green into text, as a list that ends with NULL; 0: what it takes is no choice. */
static size_t choices_of(const option_term *term, char text[LISTED_LENGTH], const char *list[WORDS_MAX])
{
    size_t count = 0;
    snprintf(text, LISTED_LENGTH, "%.*s", (int)term->value_length, term->value ? term->value : "");
    if (strpbrk(text, "ABCDEFGHIJKLMNOPQRSTUVWXYZ"))
        return 0;
    for (char *word = strtok(text, "|"); word && count < WORDS_MAX - 1; word = strtok(NULL, "|"))
        list[count++] = word;
    list[count] = NULL;
    return count;
}

/* `value` is what it was given, or the word behind it, or NULL. */
static void refuse_option(const arguments *given, const char *word, size_t length, const char *value)
{
    char name[HINT_LENGTH];
    option_term term, hint = {.name = NULL};
    size_t least = vndf_word_slip(length);
    snprintf(name, sizeof name, "%.*s", length < HINT_LENGTH ? (int)length : HINT_LENGTH - 1, word);
    const char letter = name[strspn(name, "-")];
    const int is_letter = isalpha((unsigned char)letter) && length <= 3; /* "-a 0.3" or "--a=0.3" */
    if (is_letter && value && isdigit((unsigned char)*value) && find_option(given->help, "--set", 5, &term)) {
        complain(given->command, "there is no option '%s'; did you mean '--set %c=%s'?", name, letter, value);
        return;
    }
    for (const char *at = given->help; next_option(&at, &term);)
        if (is_letter ? !hint.name && term.name[1] == '-' && term.name[2] == letter
                      : vndf_word_is_nearer(term.name, term.name_length, name, &least))
            hint = term;
    if (hint.name)
        complain(given->command, "there is no option '%s'; did you mean '%.*s'?", name, (int)hint.name_length,
                 hint.name);
    else
        complain(given->command, "there is no option '%s'; `%s --help` lists them", name, given->command);
}

/* argv[*at] begins with '-'; moves *at on to the value if that is a word of its own. 1, or 0 after a complaint. */
static int take_option(arguments *given, int argc, char **argv, int *at)
{
    const char *word = argv[*at], *value = word, *next = *at + 1 < argc ? argv[*at + 1] : NULL;
    const char *equals = strncmp(word, "--", 2) == 0 ? strchr(word, '=') : NULL;
    const char *choices[WORDS_MAX];
    char name[HINT_LENGTH], text[LISTED_LENGTH];
    option_term term, other;
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    if (!find_option(given->help, word, length, &term))
        return (refuse_option(given, word, length, equals ? equals + 1 : next), 0);
    snprintf(name, sizeof name, "%.*s", (int)length, word);
    if (!term.value && equals)
        return complain(given->command, "%s takes no value", name), 0;
    if (term.value && equals)
        value = equals + 1;
    else if (term.value) {
        if (!next || find_option(given->help, next, strlen(next), &other))
            return complain(given->command, "%s needs a value, as in %s %.*s", name, name, (int)term.value_length,
                            term.value),
                   0;
        value = next;
        *at += 1;
    }
    if (!term.repeats && option_value(given, name))
        return complain(given->command, "%s is given twice", name), 0;
    if (choices_of(&term, text, choices) && word_among(given->command, name, value, choices) < 0)
        return 0;
    if (given->count == WORDS_MAX)
        return complain(given->command, "%s: these are more than %d options", name, WORDS_MAX), 0;
    given->option[given->count].name = word;
    given->option[given->count].length = length;
    given->option[given->count++].value = value;
    return 1;
}

int arguments_read(arguments *given, int argc, char **argv)
{
    int options_end = 0;
    for (int i = 0; i < argc; i++) {
        if (options_end || argv[i][0] != '-' || !argv[i][1]) {
            if (given->positional.count == WORDS_MAX)
                return complain(given->command, "these are more than %d words", WORDS_MAX), 0;
            given->positional.item[given->positional.count++] = argv[i];
        } else if (strcmp(argv[i], "--") == 0)
            options_end = 1;
        else if (!take_option(given, argc, argv, &i))
            return 0;
    }
    return 1;
}

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

int option_choice(const arguments *given, const char *name, int otherwise)
{
    const char *value = option_value(given, name), *choices[WORDS_MAX];
    char text[LISTED_LENGTH];
    option_term term;
    if (!value || !find_option(given->help, name, strlen(name), &term) || !choices_of(&term, text, choices))
        return otherwise;
    return word_among(given->command, name, value, choices);
}

const char *option_among(const arguments *given, const char *const *names)
{
    while (*names && !option_value(given, *names))
        names++;
    return *names;
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
