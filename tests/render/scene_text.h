/* A scene from text, for tests of the reader of scenes. */
#ifndef TESTS_RENDER_SCENE_TEXT_H
#define TESTS_RENDER_SCENE_TEXT_H

#include <stdlib.h>
#include <string.h>

#include "render/scene/scene.h"

enum { MESSAGE = 1024 };

/* What else a scene needs: two lines. */
#define LIT "camera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"

/* Reads text as the file tests/x.scene. */
static inline int read_text(scene *made, const char *text, char message[MESSAGE])
{
    size_t length = strlen(text);
    char *copy = malloc(length + 1);
    if (!copy)
        return 0;
    memcpy(copy, text, length + 1);
    message[0] = '\0';
    int good = scene_read_text(made, VNDF_SOURCE_DIR "/tests/x.scene", copy, length, message, MESSAGE);
    free(copy);
    return good;
}

#endif
