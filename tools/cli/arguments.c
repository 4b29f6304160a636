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

const char *did_you_mean(const char *word, const char *const *candidates, size_t count)
{
    static char text[64];
    const char *nearest = nearest_word(word, candidates, count);
    snprintf(text, sizeof text, "; did you mean '%s'?", nearest ? nearest : "");
    return nearest ? text : "";
}

const char *list_words(const char *const *candidates, const char *before)
{
    static char listed[LISTED_LENGTH];
    size_t at = 0;
    for (size_t i = 0; candidates[i] && at < LISTED_LENGTH; i++) {
        const char *between = i == 0 ? "" : candidates[i + 1] ? ", " : " or ";
        at += (size_t)snprintf(listed + at, LISTED_LENGTH - at, "%s%s%s", between, before, candidates[i]);
    }
    return listed;
}

/* ---- the help as a table of options -------------------------------------------------------------- */

static void read_help(arguments *given, const char *help)
{
    int above = -1;
    for (const char *line = help; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const size_t indent = strspn(line, " ");
        const char *at = line + indent;
        while ((indent == 2 || indent == 4) && *at == '-' && given->options < OPTIONS_MAX) {
            struct option *o = &given->option[given->options++];
            size_t length = strcspn(at, " ,\n");
            snprintf(o->name, sizeof o->name, "%.*s", (int)length, at);
            at += length;
            o->part_of = indent == 4 ? above : -1;
            above = indent == 4 ? above : (int)given->options - 1;
            if (*at == ' ' && at[1] != ' ') {
                for (length = 0, at++; at[length] && at[length] != '\n' && strncmp(at + length, "  ", 2) != 0 &&
                                       strncmp(at + length, ", -", 3) != 0;)
                    length++;
                o->repeats = length > 4 && strncmp(at + length - 4, " ...", 4) == 0;
                snprintf(o->value, sizeof o->value, "%.*s", (int)length - (o->repeats ? 4 : 0), at);
                at += length;
            }
            at += strncmp(at, ", -", 3) == 0 ? 2 : 0;
        }
    }
}

/* NULL: the help has none of that name. */
static const struct option *find_option(const arguments *given, const char *name, size_t length)
{
    for (size_t i = 0; i < given->options; i++)
        if (strlen(given->option[i].name) == length && memcmp(given->option[i].name, name, length) == 0)
            return &given->option[i];
    return NULL;
}

/* The words of a value, red|green or dfg,energy, are noted in o->which. 0 after a complaint. */
static int read_choices(const arguments *given, struct option *o, const char *value)
{
    char text[LISTED_LENGTH], word[40];
    const char *choice[WORDS_MAX] = {NULL};
    size_t choices = 0, letters;
    strcpy(text, o->value);
    for (char *at = strtok(text, "|,"); at && choices < WORDS_MAX - 1; at = strtok(NULL, "|,"))
        choice[choices++] = at;
    for (const char *at = value;; at += letters + 1) {
        size_t k = 0;
        letters = strchr(o->value, ',') ? strcspn(at, ",") : strlen(at);
        snprintf(word, sizeof word, "%.*s", (int)(letters < sizeof word ? letters : sizeof word - 1), at);
        while (k < choices && strcmp(word, choice[k]) != 0)
            k++;
        for (size_t i = 0; i < o->chosen; i++)
            if (o->which[i] == (int)k)
                return denied(given->command, "%s '%s' has '%s' twice", o->name, value, word);
        if (k == choices)
            return denied(given->command, "%s '%s' is not %s%s", o->name, word, list_words(choice, ""),
                          did_you_mean(word, choice, choices));
        o->which[o->chosen++] = (int)k;
        if (!at[letters])
            return 1;
    }
}

/* ---- reading ------------------------------------------------------------------------------------- */

/* The option that an unknown one may be: "-a" is --alpha, "--lang" --language, "--thta" --theta, "--bytes" --max-bytes,
 * "--output" -o; "-a 3" is --set a=3. `value` is what it was given, or the word behind it, or NULL; 0. */
static int refuse_option(const arguments *given, const char *word, size_t length, const char *value)
{
    const char *names[OPTIONS_MAX], *hint = NULL, *short_one = NULL, *bare = word + strspn(word, "-");
    const int letters = (int)length - (int)(bare - word);
    char name[32];
    for (size_t i = 0; i < given->options; i++) {
        const char *its = names[i] = given->option[i].name;
        if (!hint && (letters == 1 ? its[1] == '-' && its[2] == *bare : strncmp(its, word, length) == 0))
            hint = its;
        short_one = its[1] == *bare && !its[2] ? its : short_one;
    }
    snprintf(name, sizeof name, "%.*s", (int)length, word);
    if (!hint && letters > 1)
        hint = nearest_word(name, names, given->options);
    for (size_t i = 0; i < given->options && length > 4 && !hint; i++)
        hint = strstr(names[i], name + strspn(name, "-")) ? names[i] : NULL;
    hint = hint ? hint : short_one;
    if (letters == 1 && isalpha((unsigned char)*bare) && value && isdigit((unsigned char)*value) &&
        find_option(given, "--set", 5))
        return denied(given->command, "there is no option '%.*s'; did you mean '--set %c=%s'?", (int)length, word,
                      *bare, value);
    return denied(given->command, "there is no option '%.*s'; %s%s%s", (int)length, word,
                  hint ? "did you mean '" : "--help lists them", hint ? hint : "", hint ? "'?" : "");
}

/* argv[*at] begins with '-'; moves *at on to the value if that is a word of its own. 1, or 0 after a complaint. */
static int take_option(arguments *given, int argc, char **argv, int *at)
{
    const char *word = argv[*at], *value = word, *next = *at + 1 < argc ? argv[*at + 1] : NULL, *wrong = NULL;
    const char *equals = strchr(word, '='), *attached = equals ? equals + 1 : NULL;
    const size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const struct option *found = find_option(given, word, length);
    if (!found && length > 2 && isdigit((unsigned char)word[2]) && (found = find_option(given, word, 2)) != NULL)
        attached = word + 2; /* -n10 */
    if (!found)
        return refuse_option(given, word, length, equals ? attached : next);
    struct option *o = &given->option[found - given->option];
    if (*o->value && attached)
        value = attached;
    else if (*o->value && next && !find_option(given, next, strlen(next)))
        value = argv[++*at];
    else if (*o->value)
        return denied(given->command, "%s needs a value, as in %s %s", o->name, o->name, o->value);
    if (!*o->value && attached)
        wrong = "takes no value";
    else if (!o->repeats && o->given.count)
        wrong = strchr(o->value, ',') ? "is given twice; its values have commas between them" : "is given twice";
    else if (o->given.count == WORDS_MAX)
        wrong = "is given more often than this program reads";
    if (wrong)
        return denied(given->command, "%s %s", o->name, wrong);
    o->given.item[o->given.count++] = value;
    return !*o->value || strpbrk(o->value, "ABCDEFGHIJKLMNOPQRSTUVWXYZ") || read_choices(given, o, value);
}

int arguments_read(arguments *given, const char *command, const char *help, int argc, char **argv)
{
    int options_end = 0;
    *given = (arguments){.command = command};
    read_help(given, help);
    for (int i = 0; i < argc; i++) {
        if (options_end || argv[i][0] != '-' || !argv[i][1]) {
            if (given->positional.count == WORDS_MAX)
                return denied(command, "these are more than %d words", WORDS_MAX);
            if (strchr(argv[i], '=') && !strchr(argv[i], '/') && find_option(given, "--set", 5))
                return denied(command, "'%s' is not expected; did you mean '--set %s'?", argv[i], argv[i]);
            given->positional.item[given->positional.count++] = argv[i];
        } else if (strcmp(argv[i], "--") == 0)
            options_end = 1;
        else if (!take_option(given, argc, argv, &i))
            return 0;
    }
    for (const struct option *o = given->option; o < given->option + given->options; o++)
        if (o->given.count && o->part_of >= 0 && !given->option[o->part_of].given.count)
            return denied(command, "%s is for %s, which is not given", o->name, given->option[o->part_of].name);
    return 1;
}

/* ---- what was given ------------------------------------------------------------------------------ */

static const struct option *known_option(const arguments *given, const char *name)
{
    const struct option *o = find_option(given, name, strlen(name));
    if (!o) {
        complain(given->command, "its help has no item %s, for which its code asks", name);
        abort();
    }
    return o;
}

words option_values(const arguments *given, const char *name)
{
    return known_option(given, name)->given;
}

const char *option_value(const arguments *given, const char *name)
{
    const words *its = &known_option(given, name)->given;
    return its->count ? its->item[0] : NULL;
}

size_t option_choices(const arguments *given, const char *name, int which[WORDS_MAX])
{
    const struct option *o = known_option(given, name);
    memcpy(which, o->which, o->chosen * sizeof *which);
    return o->chosen;
}

int option_choice(const arguments *given, const char *name, int otherwise)
{
    const struct option *o = known_option(given, name);
    return o->chosen ? o->which[0] : otherwise;
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
    for (const char *const *name = names; *name && !other; name++)
        other = *name != one && option_value(given, *name) ? *name : NULL;
    if (other)
        complain(given->command, "%s and %s are given; only one is possible of %s", one, other,
                 list_words(names, ""));
    else if (!one)
        complain(given->command, "exactly one is needed of %s; --help has an example", list_words(names, ""));
    return other ? NULL : one;
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
    return denied(command, "%s '%s' %s", what, text, why);
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
        return denied(given->command, "%s '%s' is not a whole number", name, option_value(given, name));
    *count = (unsigned long long)number;
    return 1;
}
