#!/bin/bash
# test_cli_units.sh - the units that model files state are used for --scale, and
# the names of the objects of 3MF.
. "$(dirname "$0")/tap.sh"
. "$(dirname "$0")/cli.sh"

# The same triangle, 1 by 2 units, as glTF, as 3MF and as OBJ.
cat >a.gltf <<'END'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
"min":[0,0,0],"max":[1,2,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}]}
END
printf 'v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n' >a.obj
if ! "$recto" a.gltf --view front -o a.svg 2>err; then
  echo "1..0 # SKIP built without Assimp, or without its glTF"
  exit 0
fi

box() { # FILE - width and height of what is drawn
  grep -o ' d="[^"]*"' "$1" | tr -c '0-9.-' ' ' | awk '
    { for (i = 1; i < NF; i += 2) {
        if (n++ == 0) { a = c = $i; b = d = $(i + 1) }
        if ($i < a) a = $i; if ($i > c) c = $i
        if ($(i + 1) < b) b = $(i + 1); if ($(i + 1) > d) d = $(i + 1) } }
    END { printf "%g %g\n", c - a, d - b }'
}
is_drawn() { # "WIDTH HEIGHT" ARGUMENT...
  local wanted=$1
  shift
  run 0 "$@" --view front -o a.svg && test "$(box a.svg)" = "$wanted" &&
    run 0 "$@" --view front --check a.svg && return 0
  say "$(box a.svg), not $wanted" && false
}
claim "glTF is in metres" is_drawn "10 20" a.gltf --scale 1:100
claim "unless said otherwise" is_drawn "10 20" a.gltf --scale 1:1 --unit cm
claim "OBJ is in millimetres" is_drawn "10 20" a.obj --scale 10
claim "and two of one unit are of that" is_drawn "10 20" a.gltf a.gltf --scale 1:100
cat >a.dae <<'END'
<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>
<contributor/>
<created>2020-01-01T00:00:00</created>
<modified>2020-01-01T00:00:00</modified>
<unit name="inch" meter="0.0254"/>
<up_axis>Z_UP</up_axis>
</asset>
<library_geometries>
<geometry id="m" name="m">
<mesh>
<source id="p">
<float_array id="pa" count="9">0 0 0 1 0 0 0 0 2</float_array>
<technique_common>
<accessor source="#pa" count="3" stride="3">
<param name="X" type="float"/>
<param name="Y" type="float"/>
<param name="Z" type="float"/>
</accessor>
</technique_common>
</source>
<vertices id="v">
<input semantic="POSITION" source="#p"/>
</vertices>
<triangles count="1">
<input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2</p>
</triangles>
</mesh>
</geometry>
</library_geometries>
<library_visual_scenes>
<visual_scene id="s">
<node id="n">
<instance_geometry url="#m"/>
</node>
</visual_scene>
</library_visual_scenes>
<scene>
<instance_visual_scene url="#s"/>
</scene>
</COLLADA>
END
if "$recto" a.dae --view front -o a.svg 2>err; then
  claim "Collada's unit and axis are known" is_drawn "25.4 50.8" a.dae --scale 1
else
  skip "Collada's unit and axis are known" "this Assimp reads no Collada"
fi
is_as_large() {
  run 0 a.obj --view front -o b.svg && run 0 a.gltf --view front -o a.svg &&
    test "$(box a.svg)" = "$(box b.svg)"
}
claim "a page is filled whatever the unit" is_as_large

# Models of several units together: what states none is in millimetres.
claim "a model of unknown unit beside glTF is in millimetres" \
  is_drawn "10 20" a.gltf a.obj --scale 1:100
claim "also where it is the first" is_drawn "10 20" a.obj a.gltf --scale 1:100
warns_of() { # TEXT ARGUMENT... - that alone
  local text=$1
  shift
  run 0 "$@" --view front -o a.svg && test "$(cat err)" = "$text" && return 0
  say "$(cat err)" && false
}
unknown="recto: a.obj: does not say its unit, as another model does: taken for mm; \
--unit leaves all models as they are"
claim "a warning names it" warns_of "$unknown" a.gltf a.obj
claim "also where it is the first, and once each" \
  warns_of "$unknown"$'\n'"$unknown" a.obj a.gltf a.obj
claim "two of unknown units are as they are" warns_of "" a.obj a.obj
claim "and so is what is of one unit" warns_of "" a.gltf a.gltf
claim "and all with --unit" warns_of "" a.obj a.gltf --unit m
claim "which says the unit of all" \
  is_drawn "10 20" a.obj a.gltf --scale 1:100 --unit m
claim "and is used without --scale too" warns_of "" a.gltf a.obj --unit cm
draws_the_same() { # FILE ARGUMENT... - as that model
  local file=$1
  shift
  run 0 "$@" --view front -o a.svg && run 0 "$@" --view front --check a.svg &&
    run 0 "$file" --view front --scale 1:40 -o b.svg || return
  test "$(grep -o ' d="[^"]*"' a.svg | sort)" = \
    "$(grep -o ' d="[^"]*"' b.svg | sort)" && return 0
  say "$(grep ' d=' a.svg b.svg)" && false
}
# The same triangle with +z up.
cat >a.stl <<'END'
solid
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 2
endloop
endfacet
endsolid
END
large='g large\nv 1000 0 0\nv 0 2000 0\nv 0 0 0\nf -1 -3 -2\n'
small='g small\nv 1 0 0\nv 0 2 0\nv 0 0 0\nf -1 -3 -2\n'
printf '%b' "$large$small" >large.obj && printf '%b' "$small$large" >small.obj
claim "models with other up axes stand upright" \
  draws_the_same large.obj a.gltf a.stl --scale 1:40
claim "in either order" draws_the_same small.obj a.stl a.gltf --scale 1:40
up="recto: a.obj: turned, as up is taken for +Y in it and for +Z in the first \
model; --up leaves all models as they are"
claim "of a likely axis that differs is warned" warns_of "$up" a.stl a.obj
claim "but not with --up" warns_of "" a.stl a.obj --up z
is_turned_with_up() {
  run 0 a.stl a.obj --view front --up z --scale 10 -o a.svg &&
    test "$(box a.svg)" = "10 20" &&
    run 0 a.obj --view front --up z --scale 10 -o a.svg &&
    test "$(box a.svg)" = "10 0"
}
claim "which leaves all as they are" is_turned_with_up
claim "a scale beyond all numbers is refused" \
  refuses "the scale must be" a.gltf -o no.svg --scale 1e307

if command -v python3 >/dev/null; then
  # archive FILE UNIT METHOD [OBJECTS-AND-BUILD]
  archive() {
    python3 - "$@" <<'END'
import sys
import zipfile
path, unit, method = sys.argv[1:4]
mesh = """<mesh><vertices>
<vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="0" z="2"/>
</vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>"""
objects = """<object id="1" type="model">MESH</object></resources>
<build><item objectid="1"/></build>""" if len(sys.argv) < 5 else sys.argv[4]
objects = objects.replace("MESH", mesh)
model = f"""<?xml version="1.0" encoding="UTF-8"?>
<model {unit} xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources>{objects}</model>"""
ns = "http://schemas.openxmlformats.org/package/2006/"
with zipfile.ZipFile(path, "w", getattr(zipfile, "ZIP_" + method)) as z:
    z.writestr("[Content_Types].xml", f'<Types xmlns="{ns}content-types">'
               '<Default Extension="rels" ContentType="application/vnd.'
               'openxmlformats-package.relationships+xml"/><Default '
               'Extension="model" ContentType="application/vnd.ms-package.'
               '3dmanufacturing-3dmodel+xml"/></Types>')
    z.writestr("_rels/.rels", f'<Relationships xmlns="{ns}relationships">'
               '<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http:'
               '//schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
               "</Relationships>")
    z.writestr("3D/3dmodel.model", model)
END
  }
  archive inch.3mf 'unit="inch"' DEFLATED && archive foot.3mf 'unit="foot"' STORED &&
    archive none.3mf '' DEFLATED
  if "$recto" none.3mf --view front -o a.svg 2>err; then
    claim "3MF says its unit" is_drawn "25.4 50.8" inch.3mf --scale 1
    claim "also where it is not compressed" is_drawn "30.48 60.96" foot.3mf --scale 0.1
    claim "without a unit it is in millimetres" is_drawn "10 20" none.3mf --scale 10
    from_a_pipe() {
      "$recto" --from 3mf - --view front --scale 1 -o a.svg <inch.3mf &&
        test "$(box a.svg)" = "25.4 50.8"
    }
    claim "also from a pipe" from_a_pipe
    small='g small\nv 25.4 0 0\nv 0 50.8 0\nv 0 0 0\nf -1 -3 -2\n'
    printf '%b' "$large$small" >large.obj && printf '%b' "$small$large" >small.obj
    claim "3MF and glTF together have their sizes, and stand upright" \
      draws_the_same small.obj inch.3mf a.gltf --scale 1:40
    claim "in either order" \
      draws_the_same large.obj a.gltf inch.3mf --scale 1:40
    claim "and nothing is to be warned of" warns_of "" a.gltf inch.3mf
    printf 'v 0 0 0\nv 1e307 0 0\nv 0 2 0\nf 1 2 3\n' >huge.obj
    archive micron.3mf 'unit="micron"' DEFLATED
    is_too_large() {
      run 1 micron.3mf huge.obj -o no.svg && test ! -e no.svg &&
        says "huge.obj: too large in the unit of the first model"
    }
    claim "a coordinate beyond all numbers is an error" is_too_large
    # Four objects side by side; the third and the fourth have one name.
    archive named.3mf '' DEFLATED '<object id="1" name="Lid &amp; &#x42;ox">MESH</object>
<object id="2">MESH</object><object id="3" name="Leg">MESH</object>
<object id="4" name="Leg">MESH</object></resources><build>
<item objectid="1"/><item objectid="2" transform="1 0 0 0 1 0 0 0 1 3 0 0"/>
<item objectid="3" transform="1 0 0 0 1 0 0 0 1 6 0 0"/>
<item objectid="4" transform="1 0 0 0 1 0 0 0 1 9 0 0"/></build>'
    has_names() {
      "$recto" "$@" --view front --ids -o a.svg || return
      grep -o 'data-group="[^"]*"' a.svg >names
      test "$(sort -u names | tr '\n' ' ')" = 'data-group="Leg.3" data-group="Leg.4" '`
        `'data-group="Lid &amp; Box" data-group="Object_2" ' && return 0
      say "$(cat names)" && false
    }
    claim "objects of 3MF have their names" has_names named.3mf
    claim "also from a pipe" has_names --from 3mf - <named.3mf
  else
    skip "3MF says its unit" "this Assimp reads no 3MF"
  fi
else
  skip "3MF says its unit" "no python3 here"
fi
finish
