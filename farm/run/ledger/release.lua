-- Gives an owner's claim up.
--
-- KEYS[1]  claims: sorted set of job ids; the score is when the claim lapses, in seconds of the Unix epoch
-- KEYS[2]  owners: hash from job id to the owner of its claim
-- KEYS[3]  starts: hash from job id to the number of its starts
-- ARGV[1]  job id
-- ARGV[2]  owner that holds the claim
-- ARGV[3]  1 to take back the count of the start too, 0 to keep it
-- Returns  1; 0 if the claim is not the owner's, and then nothing changes

if redis.call('HGET', KEYS[2], ARGV[1]) ~= ARGV[2] then
    return 0
end

redis.call('ZREM', KEYS[1], ARGV[1])
redis.call('HDEL', KEYS[2], ARGV[1])
if ARGV[3] == '1' then
    redis.call('HINCRBY', KEYS[3], ARGV[1], -1)
end
return 1
