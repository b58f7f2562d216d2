// three.mjs - three-svg-renderer on a model, without its fills:
//   node three.cjs MODEL OUT EYE-DISTANCE FOV
// where three.cjs is this file bundled (peers.sh).  The model is in page
// coordinates and seen in perspective along -z from that distance; OUT gets a
// line of x y z, x y z, ... a polyline.
import fs from 'fs';
import * as THREE from 'three';
import {SVGMesh, Viewmap} from 'three-svg-renderer';
const [model, out, distance, fov] = process.argv.slice(2);
const position = [], index = [];
for (const line of fs.readFileSync(model, 'utf8').split('\n')) {
  const word = line.trim().split(/\s+/);
  if (word[0] === 'v')
    position.push(...word.slice(1, 4).map(Number));
  if (word[0] === 'f')
    for (let k = 2; k + 1 < word.length; k++)
      index.push(...[word[1], word[k], word[k + 1]].map(w => parseInt(w) - 1));
}
const geometry = new THREE.BufferGeometry();
geometry.setAttribute('position',
                      new THREE.Float32BufferAttribute(position, 3));
geometry.setIndex(index);
geometry.computeVertexNormals();
const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial());
mesh.updateMatrixWorld();
const camera = new THREE.PerspectiveCamera(+fov, 1, 1, 1e5);
camera.position.set(0, 0, +distance);
camera.lookAt(0, 0, 0);
camera.updateMatrixWorld();
camera.updateProjectionMatrix();
const viewmap = new Viewmap({creaseAngle: {min: 30, max: 180}});
// Fills need arrangement-2d-js, which npm does not have; lines do not.
const all = viewmap.setupActions.bind(viewmap);
viewmap.setupActions =
    info => all(info).filter(a => !/polygon/i.test(a.name));
console.info = () => {};
viewmap.build([new SVGMesh(mesh)], camera, {w: 2000, h: 2000}).then(() => {
  const visible = viewmap.chains.filter(c => c.visibility === 'Visible');
  fs.writeFileSync(out, visible.map(
      c => c.vertices.map(v => v.pos3d.toArray().join(' ')).join(' ') + '\n')
                            .join(''));
});
