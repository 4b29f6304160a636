# vndf render: a scene becomes the same picture for any number of threads; wrong words are refused with status 2
# and leave nothing behind; --explain tells what the scene calls for; the language of scenes is printed.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)
set(scene ${OUT}/ball.scene)
file(WRITE ${scene} "film width 24 height 16\ncamera from 0 0 5 to 0 0 0\nintegrator samples 3\n"
    "environment constant 1 1 1\nmaterial red matte colour 0.8 0.1 0.1\nmaterial glass glass index 1.5\n"
    "material gold conductor of gold distribution ggx alpha 0.2\nmaterial lamp light radiance 5 5 5\n"
    "material ice dielectric index 1.3 distribution ggx alpha 0.1\n"
    "sphere centre 0 0 0 radius 0.5 material red\nsphere centre 1 0 0 radius 0.4 material glass\n"
    "sphere centre -1 0 0 radius 0.4 material gold\nsphere centre 0 2 0 radius 0.2 material lamp\n"
    "sphere centre 0 -1 0 radius 0.4 material ice\n")
set(mapped ${OUT}/mapped.scene)
file(WRITE ${mapped} "camera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
    "image blots pattern blots width 8 height 8\n"
    "material rough conductor of gold distribution ggx alpha 0.2 alpha-map blots\n"
    "sphere centre 0 0 0 radius 0.5 material rough\n")
set(lobes ${OUT}/lobes.scene)
file(WRITE ${lobes} "film width 24 height 16\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
    "image blots pattern blots width 8 height 8\nlobe core distribution ggx alpha 0.1\n"
    "lobe haze distribution ggx matrix 0.4 0.1 0 0.3 weight-map blots height-map blots scale 0.1 mean 0.1 0\n"
    "material rough conductor of gold mix core haze\nsphere centre 0 0 0 radius 0.5 material rough\n")

answers(0 "24 x 16 pixels, 3 samples each" render ${scene} -o one.pfm --threads 1)
answers(0 "24 x 16 pixels, 3 samples each" render ${scene} -o three.pfm --threads 3)
answers(0 "12 x 8 pixels, 2 samples each" render ${scene} -o small.png --width 12 --spp 2 --sampler visible)
answers(0 "pixels" render ${scene} -o other.pfm --seed 5)
answers(0 "perfect sampling: 2 BSDFs precomputed" render ${scene} -o perfect.pfm --sampler perfect --spp 1)
answers(0 "microfacets" render ${scene} --explain)
answers(0 "of the time of a path, over the heaviest lobe" render ${lobes} --explain)
answers(0 "textured weights" render ${lobes} --explain)
file(WRITE ${OUT}/white.scene "film width 24 height 16\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
    "material a shape distribution ggx alpha 1 scattering turquin\nsphere centre 0 0 0 radius 0.5 material a\n"
    "material b shape distribution ggx alpha 1 scattering kulla-conty\nsphere centre 1 0 0 radius 0.4 material b\n")
answers(0 "energy compensation: 1 table of albedos built" render ${OUT}/white.scene -o white.pfm)
answers(0 "of the time of a path, over single scattering" render ${OUT}/white.scene --explain)
answers(0 "beside one.pfm pixels differ by 0.00% of its mean luminance" render ${scene} -o again.pfm
    --against one.pfm)
answers(2 "one.pfm has 24 x 16 pixels, this picture has 12 x 8" render ${scene} -o no.pfm --width 12
    --against one.pfm)
answers(2 "--against: " render ${scene} -o no.pfm --against none.pfm)
answers(2 "give -o a file" render ${scene} --explain --against one.pfm)
answers(0 "example:" render --help)
answers(0 "stripes  64 upright stripes" render --grammar)
file(SHA256 ${OUT}/one.pfm one)
file(SHA256 ${OUT}/three.pfm three)
file(SHA256 ${OUT}/other.pfm other)
if(NOT one STREQUAL three)
    message(SEND_ERROR "one thread and three make different images")
endif()
if(one STREQUAL other)
    message(SEND_ERROR "two seeds make the same image")
endif()

answers(2 "SCENE is missing" render)
answers(2 "-o OUT.png or -o OUT.pfm is missing" render ${scene})
answers(2 "must end in .png or .pfm" render ${scene} -o no.gif)
answers(2 "did you mean 'bounded'?" render ${scene} -o no.png --sampler bouned)
answers(2 "material 'ice': normals bounded, normals that reflect to above the horizon: lobes must be reflection"
    render ${scene} -o no.png --sampler bounded)
answers(2 "material 'rough': perfect sampling is precomputed for one roughness, this one has a map" render
    ${mapped} -o no.png --sampler perfect)
answers(2 "no.scene" render no.scene -o no.png)
answers(2 "--width: a film of 24 x 16 pixels becomes 16384 x 10923" render ${scene} -o no.png --width 16384)
answers(2 "--spp" render ${scene} -o no.png --spp 0)
answers(2 "cannot write" render ${scene} -o ${OUT}/nowhere/no.png)
file(GLOB left ${OUT}/*no* ${OUT}/*.tmp)
if(left)
    message(SEND_ERROR "left behind: ${left}")
endif()
