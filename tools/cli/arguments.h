/* The words that a command is given. The text that its --help prints is the table of its options: an item in column 2
 * names them, and an item in column 4 those that are possible only with an option of the item above it. Read is
 *
 *     --seed S         takes a value, once          --set NAME=X ...          takes values, as often as one likes
 *     --hard           is a flag                    --channel red|green       takes one of these words
 *     --ndf EXPR, --slope EXPR   are two            --what dfg,energy         takes some of them between commas
 *
 * with two blanks before what is said of them. A value may follow = (--seed=7, -n=10), a number an option of one letter
 * at once (-n10). Every refusal says which word was wrong and what would be right. */
#pragma once

#include <stddef.h>

#if defined(__GNUC__)
#  define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#  define PRINTF_LIKE(text, first)
#endif

enum { WORDS_MAX = 64, OPTIONS_MAX = 40, LISTED_LENGTH = 256 };

/* In the order given; they belong to argv. */
typedef struct words {
    const char *item[WORDS_MAX];
    size_t count;
} words;

typedef struct arguments {
    const char *command; /* "vndf build": opens every message */
    words positional;    /* what is no option */
    size_t options;
    struct option {
        char name[24], value[LISTED_LENGTH]; /* as the help has them; "": a flag */
        int repeats, part_of;                /* part_of: the option that it goes with; -1: none */
        words given;                         /* its values; of a flag its name */
        int which[WORDS_MAX];                /* its words, where it takes some of a list */
        size_t chosen;
    } option[OPTIONS_MAX];
} arguments;

/* Reads the help and argv. Returns 1, or 0 after a complaint. */
int arguments_read(arguments *given, const char *command, const char *help, int argc, char **argv);

/* The first value of an option, NULL if it was not given; and all of them. Ends the program for an option that the help
 * does not name. */
const char *option_value(const arguments *given, const char *name);
words option_values(const arguments *given, const char *name);

/* Of --channel red|green and --what dfg,energy: which of the words were given, in that order, and how many. */
size_t option_choices(const arguments *given, const char *name, int which[WORDS_MAX]);

/* Which one, `otherwise` if it was not given. */
int option_choice(const arguments *given, const char *name, int otherwise);

/* Whether one of these options was given, NULL ends them: its name, or NULL. The same, if no other was, too; with more
 * or none NULL after a complaint. */
const char *option_among(const arguments *given, const char *const *names);
const char *option_alone(const arguments *given, const char *const *names);

/* One number for an option that may be absent: *number keeps its value then. 0 after a complaint. */
int option_number(const arguments *given, const char *name, double low, double high, double *number);

/* The same for a whole number in [low, high], high <= 2^53; "1e6" is read as 1000000. */
int option_count(const arguments *given, const char *name, double low, double high, unsigned long long *count);

/* Reads `least` to `most` comma-separated finite decimal numbers in [low, high] into numbers[].
 * Returns how many; 0 after a complaint that names `what` (an option) and the offending text. */
size_t parse_numbers(const char *command, const char *what, const char *text, double low, double high,
                     size_t least, size_t most, double *numbers);

/* Adds " OPTION VALUE" for each of these options that was given to what stands in text, with quotes where a shell needs
 * them; cut where `size` ends. */
void options_text(const arguments *given, const char *const *names, char *text, size_t size);

/* "csv, md or json", with `before` in front of each; the candidates end with NULL. Until the next call. */
const char *list_words(const char *const *candidates, const char *before);

/* The candidate nearest to a misspelt word, or NULL if none is near. */
const char *nearest_word(const char *word, const char *const *candidates, size_t count);

/* The same as the end of a message, "; did you mean 'cos'?", or "". Until the next call. */
const char *did_you_mean(const char *word, const char *const *candidates, size_t count);

/* Prints "COMMAND: message" on stderr; returns STATUS_USE, so that a caller can end with it; or 0. */
int complain(const char *command, const char *format, ...) PRINTF_LIKE(2, 3);
#define denied(...) (complain(__VA_ARGS__), 0)
