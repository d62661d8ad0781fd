#!/usr/bin/env bash
# Bundles src/ with three.js and uPlot into bundle/, which the program is built from. Needs npm.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"
[[ -d node_modules ]] || npm ci --no-audit --no-fund --silent
npx esbuild src/main.js --bundle --minify --format=iife --target=chrome100,firefox113,safari16.4 --legal-comments=none \
  --outfile=bundle/page.min.js
npx esbuild src/page.css --bundle --minify --outfile=bundle/page.min.css
{
  echo "This page contains three.js and uPlot."
  for package in three uplot; do
    printf '\n%s %s\n\n' "$package" "$(node -p "require('./node_modules/$package/package.json').version")"
    cat "node_modules/$package/LICENSE"
  done
} > bundle/licences.txt
