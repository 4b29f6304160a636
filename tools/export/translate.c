/* The kernel's GLSL has one shape: declarations of structs and functions, one variable a declaration and always with a
 * value unless it is a struct, no operators of vectors. So words decide what they become; no tree is built. */
#include "export/translate.h"

#include <assert.h>
#include <string.h>

#include "export/words.h"

enum { FUNCTIONS_MAX = 128, STRUCTS_MAX = 32, FIELDS_MAX = 16, DEPTH_MAX = 32 };

/* The build translates the one kernel there is, so its shape is asserted, not judged. */

/* What was declared so far. The first function that fetches is vndf_fetch itself. */
typedef struct writer {
    const translation *t;
    FILE *to;
    const char *text;             /* the whole */
    const char *at;               /* what comes next */
    word fetching[FUNCTIONS_MAX]; /* functions that fetch numbers */
    word structs[STRUCTS_MAX];
    size_t fetching_count, struct_count;
} writer;

/* ---- words --------------------------------------------------------------------------------------- */

int translation_prefix(translation *t, const char *name)
{
    size_t n = strlen(name);
    if (n == 0 || n > PREFIX_MAX || name[0] < 'a' || name[0] > 'z' || name[n - 1] == '_' || strstr(name, "__") ||
        strcmp(name, "gl") == 0 || strncmp(name, "gl_", 3) == 0)
        return 0;
    for (size_t i = 0; i < n; i++) {
        int letter = name[i] >= 'a' && name[i] <= 'z', digit = name[i] >= '0' && name[i] <= '9';
        if (!letter && !digit && name[i] != '_')
            return 0;
        t->lower[i] = name[i];
        t->upper[i] = letter ? (char)(name[i] - 'a' + 'A') : name[i];
    }
    t->lower[n] = t->upper[n] = '_';
    t->lower[n + 1] = t->upper[n + 1] = '\0';
    return 1;
}

void translate_name(const translation *t, FILE *to, const char *name, size_t length)
{
    int lower = length >= 5 && memcmp(name, "vndf_", 5) == 0, upper = length >= 5 && memcmp(name, "VNDF_", 5) == 0;
    size_t skip = lower || upper ? 5 : 0;
    fprintf(to, "%s%.*s", lower ? t->lower : upper ? t->upper : "", (int)(length - skip), name + skip);
}

/* A name as the language has it. */
static void put_name(const writer *w, const word *name)
{
    const char *own = language_word(w->t->to, name->text, name->length);
    if (own)
        translate_name(w->t, w->to, own, strlen(own));
    else
        translate_name(w->t, w->to, name->text, name->length);
}

static int is_among(const word *list, size_t count, const word *name)
{
    for (size_t i = 0; i < count; i++)
        if (words_equal(&list[i], name))
            return 1;
    return 0;
}

static int is_struct(const writer *w, const word *name)
{
    return is_among(w->structs, w->struct_count, name);
}

static int is_type(const writer *w, const word *name)
{
    return word_is(name, "float") || word_is(name, "int") || word_is(name, "bool") || word_is(name, "vec3") ||
           is_struct(w, name);
}

static int is_fetching(const writer *w, const word *name)
{
    return w->t->by_pointer && is_among(w->fetching, w->fetching_count, name);
}

/* The next word, which is taken. */
static word take(writer *w)
{
    word next = word_at(w->at);
    w->at += next.length;
    return next;
}

/* The next one that is no space and no line break. */
static word take_solid(writer *w)
{
    word next = take(w);
    while (next.kind == WORD_SPACE || next.kind == WORD_LINE)
        next = take(w);
    return next;
}

static word peek_solid(const char *at)
{
    word next = word_at(at);
    while (next.kind == WORD_SPACE || next.kind == WORD_LINE)
        next = word_at(next.text + next.length);
    return next;
}

static void put_word(const writer *w, const word *it)
{
    fprintf(w->to, "%.*s", (int)it->length, it->text);
}

/* Names in comments have their prefix too. */
static void put_comment(const writer *w, const word *comment)
{
    for (const char *at = comment->text; at < comment->text + comment->length;) {
        word part = word_at(at == comment->text ? at + 2 : at);
        if (at == comment->text)
            fputs("//", w->to);
        if (part.text >= comment->text + comment->length)
            return;
        if (part.kind == WORD_NAME)
            translate_name(w->t, w->to, part.text, part.length);
        else
            put_word(w, &part);
        at = part.text + part.length;
    }
}

static void put_number(const writer *w, const word *number)
{
    put_word(w, number);
    if (memchr(number->text, '.', number->length) || memchr(number->text, 'e', number->length))
        fputs(w->t->to->suffix, w->to);
}

/* `type name` in the language's order. */
static void put_typed(const writer *w, const word *type, const word *name)
{
    if (w->t->to->typed_after) {
        put_word(w, name);
        fputs(": ", w->to);
        put_name(w, type);
    } else {
        put_name(w, type);
        fputs(" ", w->to);
        put_word(w, name);
    }
}

/* ---- structs ------------------------------------------------------------------------------------- */

/* A field; `count` is the number of its elements as a name, or empty. */
typedef struct field {
    word type, name, count;
    int begins; /* a declaration */
} field;

/* "name", "name[COUNT]", and what ends them: ',' or ';'. */
static word take_field(writer *w, field *f)
{
    f->name = take_solid(w);
    f->count = (word){WORD_END, "", 0};
    word end = take_solid(w);
    if (word_is(&end, "[")) {
        f->count = take_solid(w);
        take_solid(w);
        end = take_solid(w);
    }
    return end;
}

/* After the opening brace, to the closing one. */
static size_t take_fields(writer *w, field *fields)
{
    size_t count = 0;
    for (word type = take_solid(w); !word_is(&type, "}"); type = take_solid(w)) {
        word end = {WORD_SIGN, ",", 1};
        for (int first = 1; word_is(&end, ","); first = 0, count++) {
            assert(count < FIELDS_MAX);
            fields[count].type = type;
            fields[count].begins = first;
            end = take_field(w, &fields[count]);
        }
    }
    return count;
}

static void put_field_after(const writer *w, const field *f)
{
    fprintf(w->to, "    %.*s: ", (int)f->name.length, f->name.text);
    if (f->count.length) {
        fputs("array<", w->to);
        put_name(w, &f->type);
        fputs(", ", w->to);
        put_name(w, &f->count);
        fputs(">,\n", w->to);
    } else {
        put_name(w, &f->type);
        fputs(",\n", w->to);
    }
}

static void put_field(const writer *w, const field *f, int ends)
{
    if (f->begins) {
        fputs("    ", w->to);
        put_name(w, &f->type);
        fputs(" ", w->to);
    }
    put_word(w, &f->name);
    if (f->count.length) {
        fputs("[", w->to);
        put_name(w, &f->count);
        fputs("]", w->to);
    }
    fputs(ends ? ";\n" : ", ", w->to);
}

/* Whether a struct is made anywhere: its name stands before a parenthesis. */
static int is_made(const writer *w, const word *name)
{
    for (word next = word_at(w->text); next.kind != WORD_END; next = word_at(next.text + next.length))
        if (words_equal(&next, name) && next.text[next.length] == '(')
            return 1;
    return 0;
}

/* The function that makes a struct, for languages without constructors. */
static void put_maker(const writer *w, const word *name, const field *fields, size_t count)
{
    fputs("\n\n", w->to);
    put_name(w, name);
    fputs(" ", w->to);
    put_name(w, name);
    fputs("_made(", w->to);
    for (size_t i = 0; i < count; i++) {
        fputs(i ? ", " : "", w->to);
        put_typed(w, &fields[i].type, &fields[i].name);
    }
    fputs(") {\n    ", w->to);
    put_name(w, name);
    fputs(" made;\n", w->to);
    for (size_t i = 0; i < count; i++)
        fprintf(w->to, "    made.%.*s = %.*s;\n", (int)fields[i].name.length, fields[i].name.text,
                (int)fields[i].name.length, fields[i].name.text);
    fputs("    return made;\n}", w->to);
}

/* After the word `struct`. */
static void put_struct(writer *w)
{
    const language *to = w->t->to;
    field fields[FIELDS_MAX];
    word name = take_solid(w);
    take_solid(w);
    size_t count = take_fields(w, fields);
    take_solid(w); /* ; */
    assert(w->struct_count < STRUCTS_MAX);
    w->structs[w->struct_count++] = name;
    fputs(to->structs == STRUCT_TYPEDEF ? "typedef struct " : "struct ", w->to);
    put_name(w, &name);
    fputs(" {\n", w->to);
    for (size_t i = 0; i < count; i++)
        if (to->structs == STRUCT_FIELDS)
            put_field_after(w, &fields[i]);
        else
            put_field(w, &fields[i], i + 1 == count || fields[i + 1].begins);
    fputs("}", w->to);
    if (to->structs == STRUCT_TYPEDEF) {
        fputs(" ", w->to);
        put_name(w, &name);
    }
    fputs(to->structs == STRUCT_FIELDS ? "" : ";", w->to);
    if (to->made == MADE_FUNCTION && is_made(w, &name))
        put_maker(w, &name, fields, count);
}

/* ---- bodies -------------------------------------------------------------------------------------- */

/* Which sign closes each open parenthesis, and whether a statement begins here. */
typedef struct body {
    char close[DEPTH_MAX];
    int depth, braces, begins;
} body;

static void open_as(writer *w, body *b, char open, char close)
{
    fputc(open, w->to);
    assert(b->depth < DEPTH_MAX);
    b->close[b->depth++] = close;
}

/* A name before its parenthesis, which is taken too. */
static void put_call(writer *w, body *b, const word *name)
{
    const language *to = w->t->to;
    w->at++; /* ( */
    word next = peek_solid(w->at);
    if (word_is(name, "int") && to->casts) {
        fputs("(int)", w->to);
    } else if (word_is(name, "vec3") && to->vec3_made) {
        fputs(to->vec3_made, w->to);
    } else if (word_is(name, "vec3")) {
        put_name(w, name);
        fputs("_of", w->to);
    } else if (is_struct(w, name) && to->made == MADE_COMPOUND) {
        fputs("(", w->to);
        put_name(w, name);
        fputs(")", w->to);
    } else {
        put_name(w, name);
        if (is_struct(w, name) && to->made == MADE_FUNCTION)
            fputs("_made", w->to);
    }
    if (is_struct(w, name) && (to->made == MADE_COMPOUND || to->made == MADE_BRACES))
        open_as(w, b, '{', '}');
    else
        open_as(w, b, '(', ')');
    if (is_fetching(w, name))
        fputs(word_is(&next, ")") ? "numbers" : "numbers, ", w->to);
}

/* Whether a statement after `at` in the same body begins with the name: it is assigned there. */
static int is_assigned(const char *at, const word *name)
{
    int begins = 0, braces = 1;
    for (word next = word_at(at); braces > 0 && next.kind != WORD_END; next = word_at(next.text + next.length)) {
        if (next.kind == WORD_SPACE || next.kind == WORD_LINE || next.kind == WORD_COMMENT)
            continue;
        if (begins && words_equal(&next, name))
            return 1;
        braces += word_is(&next, "{") - word_is(&next, "}");
        begins = word_is(&next, ";") || word_is(&next, "{") || word_is(&next, "}");
    }
    return 0;
}

static void put_declared(writer *w, const word *type)
{
    word name = take_solid(w);
    if (w->t->to->typed_after)
        fputs(is_struct(w, type) || is_assigned(w->at, &name) ? "var " : "let ", w->to);
    put_typed(w, type, &name);
}

static void put_sign(writer *w, body *b, const word *sign)
{
    if (word_is(sign, "("))
        open_as(w, b, '(', ')');
    else if (word_is(sign, ")") && b->depth > 0)
        fputc(b->close[--b->depth], w->to);
    else
        put_word(w, sign);
    b->braces += word_is(sign, "{") - word_is(sign, "}");
}

/* After the opening brace, to the closing one. */
static void put_body(writer *w)
{
    body b = {.braces = 1, .begins = 1};
    while (b.braces > 0) {
        word next = take(w), after = peek_solid(w->at);
        if (next.kind == WORD_END)
            return;
        if (next.kind == WORD_NAME && *w->at == '(' && !word_is(&next, "if"))
            put_call(w, &b, &next);
        else if (next.kind == WORD_NAME && b.begins && is_type(w, &next) && after.kind == WORD_NAME)
            put_declared(w, &next);
        else if (next.kind == WORD_NAME)
            put_name(w, &next);
        else if (next.kind == WORD_NUMBER)
            put_number(w, &next);
        else if (next.kind == WORD_SIGN)
            put_sign(w, &b, &next);
        else if (next.kind == WORD_COMMENT)
            put_comment(w, &next);
        else
            put_word(w, &next);
        int opens_for = word_is(&next, "(") && b.depth > 0 && memcmp(next.text - 4, "for ", 4) == 0;
        if (next.kind != WORD_SPACE && next.kind != WORD_LINE && next.kind != WORD_COMMENT)
            b.begins = word_is(&next, ";") || word_is(&next, "{") || word_is(&next, "}") || opens_for;
    }
}

/* ---- functions ----------------------------------------------------------------------------------- */

/* Whether the body that begins at `at` calls a function that fetches. */
static int fetches(const writer *w, const char *at)
{
    int braces = 1;
    for (word next = word_at(at); braces > 0 && next.kind != WORD_END; next = word_at(next.text + next.length)) {
        braces += word_is(&next, "{") - word_is(&next, "}");
        if (next.kind == WORD_NAME && is_among(w->fetching, w->fetching_count, &next))
            return 1;
    }
    return 0;
}

static void put_parameters(writer *w, int by_pointer)
{
    int first = 1;
    fputs("(", w->to);
    if (by_pointer) {
        fprintf(w->to, "%snumbers", w->t->to->pointer);
        first = 0;
    }
    for (word type = take_solid(w); !word_is(&type, ")"); type = take_solid(w)) {
        if (word_is(&type, ","))
            type = take_solid(w);
        word name = take_solid(w);
        fputs(first ? "" : ", ", w->to);
        put_typed(w, &type, &name);
        first = 0;
    }
    fputs(")", w->to);
}

/* After the type of its value. */
static void put_function(writer *w, const word *type)
{
    const language *to = w->t->to;
    word name = take_solid(w);
    take_solid(w); /* ( */
    int fetching = is_among(w->fetching, 1, &name) || fetches(w, strchr(w->at, '{') + 1);
    assert(w->fetching_count < FUNCTIONS_MAX);
    if (fetching)
        w->fetching[w->fetching_count++] = name;
    fputs(to->function, w->to);
    if (!to->typed_after) {
        put_name(w, type);
        fputs(" ", w->to);
    }
    put_name(w, &name);
    put_parameters(w, fetching && w->t->by_pointer);
    if (to->typed_after) {
        fputs(" -> ", w->to);
        put_name(w, type);
    }
    take_solid(w);
    fputs(" {", w->to);
    put_body(w);
}

void translate(const translation *t, FILE *to, const char *text)
{
    writer w = {.t = t, .to = to, .text = text, .at = text};
    w.fetching[w.fetching_count++] = word_at("vndf_fetch");
    for (word next = take(&w); next.kind != WORD_END; next = take(&w)) {
        if (next.kind == WORD_COMMENT)
            put_comment(&w, &next);
        else if (next.kind != WORD_NAME)
            put_word(&w, &next);
        else if (word_is(&next, "struct"))
            put_struct(&w);
        else
            put_function(&w, &next);
    }
}
