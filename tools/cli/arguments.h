/* Words of a command line: options with values (`--tv X` or `--tv=X`, `-o FILE`), flags, positional
 * words, and numbers read strictly. Every refusal says which word was wrong and what would be right. */
#ifndef TOOLS_CLI_ARGUMENTS_H
#define TOOLS_CLI_ARGUMENTS_H

#include <stddef.h>

#if defined(__GNUC__)
#  define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#  define PRINTF_LIKE(text, first)
#endif

enum { WORDS_MAX = 64 };

/* Words collected for one option, in the order given; they belong to argv. */
typedef struct words {
    const char *item[WORDS_MAX];
    size_t count;
} words;

typedef struct option_form {
    const char *name; /* "--theta", "-o" */
    int takes_value;  /* 0: a flag, counted in values->count */
    size_t most;      /* how often it may be given, at most WORDS_MAX */
    words *values;
} option_form;

typedef struct command_form {
    const char *command; /* "vndf build": opens every message */
    const char *help;    /* printed for --help */
    const option_form *options;
    size_t option_count;
    const char *positional; /* what the positional words are, "FILE|ggx|beckmann" */
    size_t positional_min, positional_max;
} command_form;

enum { PARSE_GO_ON = -1 };

/* Fills the word lists of the options and *positional. Returns PARSE_GO_ON, or the exit status with
 * which the program is to end: help was asked for and printed, or a word was refused. */
int parse_arguments(const command_form *form, int argc, char **argv, words *positional);

/* Calls run(0, NULL): the form that it gives to parse_arguments goes to `take`, and nothing is parsed or done. */
typedef void form_taker(const command_form *form, void *user);
void take_form(int (*run)(int argc, char **argv), form_taker *take, void *user);

/* The one value of an option that may be given once, or NULL. */
const char *only_word(const words *values);

/* Reads `least` to `most` comma-separated finite decimal numbers in [low, high] into numbers[].
 * Returns how many; 0 after a complaint that names `what` (an option) and the offending text. */
size_t parse_numbers(const char *command, const char *what, const char *text, double low, double high,
                     size_t least, size_t most, double *numbers);

/* One number for an option that may be absent: *number keeps its value then. 0 after a complaint. */
int option_number(const char *command, const char *what, const words *values, double low, double high,
                  double *number);

/* The same for a whole number in [low, high], high <= 2^53; "1e6" is read as 1000000. */
int option_count(const char *command, const char *what, const words *values, double low, double high,
                 unsigned long long *count);

/* Which of these a word is, {"csv", "f32", NULL} say; -1 after a complaint that names `what` (an option), them and the
 * nearest. */
int word_among(const char *command, const char *what, const char *word, const char *const *candidates);

/* "csv, md or json", with `before` in front of each; the candidates end with NULL. */
enum { LISTED_LENGTH = 256 };
void list_words(const char *const *candidates, const char *before, char listed[LISTED_LENGTH]);

/* The candidate nearest to a misspelt word, or NULL if none is near. */
const char *nearest_word(const char *word, const char *const *candidates, size_t count);

/* Prints "COMMAND: message" on stderr; returns STATUS_USE, so that a caller can end with it. */
int complain(const char *command, const char *format, ...) PRINTF_LIKE(2, 3);

#endif
