/* As much of pbrt-v4's vectors as tools/pbrt needs, written for its test; pbrt has its own. */
#pragma once

namespace pbrt
{

using Float = float;

struct Point2f {
    Float x, y;
};

struct Vector3f {
    Float x, y, z;
};

} // namespace pbrt
