#!/usr/bin/env bash
# What the program answers, kept in files, so that a change that should change nothing can be seen
# to change nothing:
#   tests/corpus.sh PROGRAM FOLDER   runs every command of the corpus at every SIMD level
#   diff -rq FOLDER OTHER            after the same with another build
# The commit that a build names is replaced in what it writes, and checksums that follow from it are
# left out.
set -euo pipefail
program=$(readlink -f "$1")
mkdir -p "$2"
folder=$(readlink -f "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
version=$("$program" --version)
levels="plain baseline avx2 avx512"

# keep NAME ARGS...: standard output and exit status
keep() {
    local name=$1 status=0
    shift
    "$program" "$@" >"$out/$name" 2>/dev/null || status=$?
    echo "exit status $status" >>"$out/$name"
}

# keep_file NAME ARGS...: the file that -o writes
keep_file() {
    local name=$1
    shift
    "$program" "$@" --quiet -o "$out/$name" >/dev/null 2>&1 || echo "exit status $?" >"$out/$name.failed"
}

for level in $levels; do
    export IRIDO_SIMD=$level
    out=$folder/$level
    rm -rf "$out"
    mkdir -p "$out"
    for file in schemas/examples/*.json; do
        name=$(basename "$file" .json)
        keep "$name.spectrum" spectrum "$file" -w 400:780:5 -a 0,30,60,80 -p s,p
        keep "$name.layers" spectrum "$file" -w 400:700:50 -a 0,60 -p s,p --columns A_layers
        keep "$name.color" color "$file" -a 0:85:5 --side R
        keep "$name.seen" color "$file" -a 0:80:20 --method quadrature --tolerance 1e-9
        keep "$name.engines" compare "$file" -a 0:80:20
        keep "$name.cm" cm "$file" -a 0,45 -p s,p
        keep "$name.bands" bands "$file" -a 0,40 -p s,p
        keep "$name.expression" convert "$file" -f expression
        keep "$name.json" convert "$file" -f json
    done
    for method in auto quadrature fourier fourier/3 fourier-constant bloch naive equal gaussian gltf smits landmarks; do
        keep "film.${method/\//-}" color "1 | 1.4@350 | 2.1" -a 0:80:10 --method $method
        keep "mirror.${method/\//-}" color "1 | (1@200 | 1.5@180)^200 | 1" -a 0:80:10 --method $method
    done
    keep engines.random compare --random 100 --rows
    film="air | 1.33@400 | 1.9+1.5i"
    for format in csv npy exr ktx2 bin; do
        for dtype in f16 f32 f64; do
            keep_file "color.$dtype.$format" lut color "$film" --cos 0:1/17 --dtype $dtype \
                --vary layers.0.thickness_nm=0:1000/24
            keep_file "falpha.$dtype.$format" lut falpha --alpha 0.2 --dtype $dtype --size 1x33x33
            keep_file "cumulative.$dtype.$format" lut cumulative --dtype $dtype --size 64
            keep_file "sensitivity.$dtype.$format" lut sensitivity --dtype $dtype --size 1x64
        done
        keep_file "albedo.$format" lut albedo "$film" --alpha 0.1,0.4 --size 9
        keep_file "transmissivity.$format" lut transmissivity "air | 1.5@300 | 1.3" --alpha 0.1 --size 1x9x9
        keep_file "tolerance.$format" lut color "$film" --tolerance 0.5 \
            --vary layers.0.thickness_nm=0:500/2
    done
    for format in csv json npy h5; do
        for question in spectrum color bands cm; do
            stack="air | 1.45@100 | Si"
            more=()
            [ $question != spectrum ] || more=(-w 400:700:20)
            [ $question != bands ] || stack="1 | (1@200 | 1.5@180)^10 | 1"
            path=layers.0.thickness_nm
            [ $question != bands ] || path=layers.0.layers.0.thickness_nm
            keep_file "sweep.$question.$format" sweep "$stack" --vary $path=100:400:15 -a 0,50 \
                --compute $question "${more[@]}"
        done
    done
    keep spread.spectrum spectrum "air | 1.5@400 | Si" --set layers.0.thickness_sigma_nm=30 \
        -w 400:700:5 -a 0,50
    keep plate.spectrum spectrum "air | MgF2@90 | BK7@1mm! | MgF2@90 | air" -w 400:700:5 -a 0,50 -p s,p
    keep metal.spectrum spectrum "air | Ag@20 | TiO2@40 | Ag@20 | BK7" -w 300:800:2 -a 0,50 -p s,p
    keep frustrated.spectrum spectrum "2 | (1@3718 | 2.4@379)^100 | 2" -a 55 -w 400:700:5 -p s,p
    keep materials materials list
    keep stability bench stability --count 20
    if [ $level = plain ] || [ $level = avx2 ]; then
        for scene in schemas/examples/scenes/*.json; do
            keep "$(basename "$scene").plan" plan "$scene" --quiet
            "$program" bake "$scene" --quiet -o "$out/$(basename "$scene" .json)" >/dev/null 2>&1 ||
                echo "exit status $?" >"$out/$(basename "$scene").failed"
        done
    fi
done
commit=$(sed -n 's/.*(\([0-9a-f]\{7,40\}[^ ,)]*\).*/\1/p' <<<"$version" | head -1)
if [ -n "$commit" ]; then
    find "$folder" -type f -print0 | xargs -0 sed -i "s/$commit/$(sed 's/./0/g' <<<"$commit")/g"
fi
find "$folder" -type f -print0 |
    xargs -0 sed -i -E 's/(checksum": ?"sha256:)[0-9a-f]{64}/\1/g'
find "$folder" -type f | wc -l
