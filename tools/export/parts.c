#include "export/parts.h"

#include <stdlib.h>
#include <string.h>

/* ---- reading ------------------------------------------------------------------------------------- */

static part *add(part_list *parts, part_kind kind, const char *comment, const word *first)
{
    words_expect(parts->count < PARTS_MAX, first->text, "fewer declarations");
    part *p = &parts->at[parts->count++];
    *p = (part){.kind = kind, .comment = comment, .begin = first->text};
    return p;
}

static word after(const word *w)
{
    return word_solid(w->text + w->length);
}

/* typedef struct name { ... } name; */
static const char *read_struct(part_list *parts, const char *comment, const word *first)
{
    part *p = add(parts, PART_STRUCT, comment, first);
    word keyword = after(first);
    words_expect(word_is(&keyword, "struct"), first->text, "a struct");
    p->name = after(&keyword);
    p->inner = after(&p->name).text + 1;
    p->end = words_end(words_end(p->inner, "") + 1, ";") + 1;
    return p->end;
}

/* enum { A = 1, B }; */
static const char *read_enum(part_list *parts, const char *comment, const word *first)
{
    long value = 0;
    word next = after(first);
    for (next = after(&next); !word_is(&next, "}"); next = word_is(&next, ",") ? after(&next) : next) {
        part *p = add(parts, PART_CONSTANT, comment, first);
        p->name = next;
        next = after(&next);
        if (word_is(&next, "=")) {
            value = strtol(next.text + 1, NULL, 0);
            next = word_solid(words_end(next.text + 1, ","));
        }
        p->value = value++;
        p->end = next.text;
        comment = NULL;
    }
    return words_end(next.text + 1, ";") + 1;
}

/* static const float NAME[...] = {...}; */
static const char *read_array(part_list *parts, const char *comment, const word *first)
{
    part *p = add(parts, PART_ARRAY, comment, first);
    word constant = after(first);
    p->type = after(&constant);
    p->name = after(&p->type);
    p->inner = strchr(p->name.text, '{') + 1;
    p->end = words_end(p->name.text, ";") + 1;
    return p->end;
}

/* HERE type name(parameters) {...} */
static const char *read_function(part_list *parts, const char *comment, const word *first)
{
    part *p = add(parts, PART_FUNCTION, comment, first);
    words_expect(word_is(first, "HERE"), first->text, "HERE");
    p->type = after(first);
    p->name = after(&p->type);
    p->inner = after(&p->name).text + 1;
    p->body = word_solid(words_end(p->inner, "") + 1).text + 1;
    p->end = words_end(p->body, "") + 1;
    return p->end;
}

void parts_read(part_list *parts, const char *text)
{
    const char *comment = NULL;
    parts->count = 0;
    for (word next = word_at(text); next.kind != WORD_END; next = word_at(text)) {
        text = next.text + next.length;
        if (next.kind == WORD_COMMENT)
            comment = next.text;
        else if (next.kind == WORD_DIRECTIVE || (next.kind == WORD_LINE && *text == '\n'))
            comment = NULL; /* it was the file's or a section's */
        if (next.kind != WORD_NAME)
            continue;
        text = word_is(&next, "typedef")  ? read_struct(parts, comment, &next)
               : word_is(&next, "enum")   ? read_enum(parts, comment, &next)
               : word_is(&next, "static") ? read_array(parts, comment, &next)
                                          : read_function(parts, comment, &next);
        comment = NULL;
    }
}

/* ---- what is needed ------------------------------------------------------------------------------ */

part *part_named(part_list *parts, const word *name)
{
    for (size_t i = 0; i < parts->count; i++)
        if (words_equal(&parts->at[i].name, name))
            return &parts->at[i];
    return NULL;
}

void part_want(part_list *parts, part *p, int (*is_known)(const void *, const word *), const void *language)
{
    if (p->wanted)
        return;
    p->wanted = 1;
    char before = '\0';
    for (word next = word_solid(p->begin); next.text < p->end; next = after(&next)) {
        part *of = next.kind == WORD_NAME && before != '.' ? part_named(parts, &next) : NULL;
        before = *next.text;
        if (word_is(&next, "fetch"))
            p->fetches = 1;
        if (!of || of == p || (of->kind == PART_FUNCTION && *after(&next).text != '(') ||
            is_known(language, &next))
            continue;
        part_want(parts, of, is_known, language);
        p->fetches |= of->fetches;
    }
}
