/* See resolution.h. Descriptions come from table files, so they are not trusted. */
#include "source/resolution.h"

#include <math.h>
#include <string.h>

#include "core/error.h"

static const double FINEST_LEAST = 1e-9, FINEST_MOST = 1;

vndf_status vndf_resolution_check(const vndf_resolution *r, vndf_error *error)
{
    if (r->break_count > VNDF_LIMIT_BREAKS)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%lu breaks; at most %d are possible",
                         (unsigned long)r->break_count, VNDF_LIMIT_BREAKS);
    if (r->break_count > 0 && !r->breaks)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "breaks is NULL but their count is not 0");
    for (size_t i = 0; i < r->break_count; i++)
        if (!(r->breaks[i] > 0 && isfinite(r->breaks[i])))
            return vndf_fail(error, VNDF_ERROR_ARGUMENT, "a break is %g; it is a slope above 0", r->breaks[i]);
    if (r->finest != 0 && !(r->finest >= FINEST_LEAST && r->finest <= FINEST_MOST))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "finest is %g; it is a relative width from %g to %g, or 0",
                         r->finest, FINEST_LEAST, FINEST_MOST);
    return VNDF_OK;
}

char *vndf_resolution_describe(const vndf_resolution *r, const char *description, vndf_error *error)
{
    vndf_writer text = {NULL, 0, 0, 0};
    vndf_text_add(&text, description);
    for (size_t i = 0; i < r->break_count; i++) {
        vndf_text_add(&text, " --break ");
        vndf_text_add_number(&text, r->breaks[i]);
    }
    if (r->finest > 0) {
        vndf_text_add(&text, " --finest ");
        vndf_text_add_number(&text, r->finest);
    }
    return vndf_text_finish(&text, error);
}

static int is_pair(const vndf_words *words, size_t i)
{
    double value;
    const char *option = words->word[i], *number = words->word[i + 1];
    return (strcmp(option, "--break") == 0 || strcmp(option, "--finest") == 0) &&
           vndf_number_is_all(number, strlen(number), &value);
}

/* The first two words always belong to the source. */
size_t vndf_resolution_start(const vndf_words *words)
{
    size_t count = words->count;
    while (count >= 4 && is_pair(words, count - 2))
        count -= 2;
    return count;
}

vndf_status vndf_resolution_read(const char *description, double room[VNDF_LIMIT_BREAKS], vndf_resolution *r,
                                 vndf_error *error)
{
    vndf_words words;
    vndf_error inner = {VNDF_OK, ""};
    *r = (vndf_resolution){room, 0, 0};
    if (vndf_words_split(description, &words, &inner) != VNDF_OK) /* unreadable words set no resolution */
        return inner.status == VNDF_ERROR_SYNTAX ? VNDF_OK : vndf_fail(error, inner.status, "%s", inner.message);
    for (size_t i = vndf_resolution_start(&words); i + 1 < words.count; i += 2) {
        double value = 0;
        vndf_number_is_all(words.word[i + 1], strlen(words.word[i + 1]), &value);
        if (words.word[i][2] == 'f')
            r->finest = value;
        else if (r->break_count < VNDF_LIMIT_BREAKS)
            room[r->break_count++] = value;
    }
    vndf_words_free(&words);
    return vndf_resolution_check(r, error);
}
