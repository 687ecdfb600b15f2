import { DoubleSide, MeshLambertMaterial, type Plane } from "three";

/**
 * Flat faces in their colours, edges drawn by the faces themselves. Three corners a face and no index: which corner it is tells
 * where in the face a pixel is. Where faces are so small
 * that lines would fill them, all of it is as dark as lines are on the mean: no border is seen where that begins.
 */
export function faceMaterial(cut: Plane, edges: { value: number }): MeshLambertMaterial {
  const material = new MeshLambertMaterial({ vertexColors: true, flatShading: true, side: DoubleSide, clippingPlanes: [cut] });
  material.onBeforeCompile = (shader) => {
    shader.uniforms["edges"] = edges;
    shader.vertexShader = `varying vec3 inFace;\n${shader.vertexShader}`.replace(
      "#include <begin_vertex>",
      `#include <begin_vertex>
       int corner = gl_VertexID % 3;
       inFace = vec3(float(corner == 0), float(corner == 1), float(corner == 2));`,
    );
    shader.fragmentShader = `varying vec3 inFace;\nuniform float edges;\n${shader.fragmentShader}`.replace(
      "#include <opaque_fragment>",
      `vec3 width = fwidth(inFace);
       vec3 far = smoothstep(vec3(0.0), width * 1.1, inFace);
       float line = 1.0 - min(min(far.x, far.y), far.z);
       float dense = smoothstep(0.08, 0.3, max(max(width.x, width.y), width.z));
       outgoingLight = mix(outgoingLight, vec3(0.06, 0.08, 0.12), 0.75 * mix(line, 0.38, dense) * edges);
       if (!gl_FrontFacing) outgoingLight *= 0.45;
       #include <opaque_fragment>`,
    );
  };
  return material;
}
