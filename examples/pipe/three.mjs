// three.js' Ray.intersectTriangle under Node as a tracer, in the version that is named:
//
//   npm install                                     # in this folder; package.json names both versions
//   plumbline sweep --tracer 'pipe:node three.mjs three-160' --tracer 'pipe:node three.mjs three-187'
//
// It searches t from 0 on and takes no other range: a case with one is answered with null, which is a fault.
import { createInterface } from 'node:readline';

const version = process.argv[2] ?? 'three-187';
const { Ray, Vector3 } = await import(version).catch(() => {
  console.error(`three.mjs: the package '${version}' is missing: run 'npm install' in the folder of three.mjs`);
  process.exit(1);
});

const number = (x) => (typeof x === 'string' ? Number(x.replace('inf', 'Infinity')) : x);
const vector = (xs) => new Vector3(...xs.map(number));
const ray = new Ray();
const point = new Vector3();

function answer(asked) {
  const given = number(asked.t_min ?? 0) !== 0 || number(asked.t_max ?? Infinity) !== Infinity;
  if (given || !asked.triangle) return { hit: null };
  ray.set(vector(asked.origin), vector(asked.direction));
  const [a, b, c] = asked.triangle.map(vector);
  return { hit: ray.intersectTriangle(a, b, c, false, point) !== null };
}

for await (const line of createInterface({ input: process.stdin })) {
  const asked = JSON.parse(line);
  process.stdout.write(JSON.stringify({ ...asked, ...answer(asked) }) + '\n');
}
